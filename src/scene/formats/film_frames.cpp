// Decodes films with the program ffmpeg. A stream of frames starts where one was asked for and is
// read as long as later frames are asked for; then it is cheaper than a new stream.
#include "scene/formats/film_frames.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/clock.h"
#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/json_reader.h"
#include "scene/limits.h"
#include "system/watched_program.h"

namespace holomorph {
namespace {

constexpr double kPatienceMs = 60000;  ///< how long ffmpeg may take for its next answer

/// What the decoder needs to know about a film.
struct FilmStream {
  Path file;
  FilmInfo info;
  std::string decoder = {};  ///< empty: the usual one
};

std::string needs(const Path& file, const std::string& program) {
  return file.string() + ": films need the program " + program +
         ", which is not installed; install the package ffmpeg";
}

[[noreturn]] void fail(const Path& file, const std::string& why) {
  throw Error(ErrorKind::bad_input, file.string() + ": " + why);
}

/// A ratio such as "30000/1001"; 0 if it is not one.
double ratio_of(const Json& object, const char* key) {
  const std::string text = object.value(key, "");
  double over = 0, under = 0;
  if (std::sscanf(text.c_str(), "%lf/%lf", &over, &under) != 2 || under <= 0) return 0;
  return over / under;
}

/// The lowest rate at which each frame of the film has a number of its own, or else the average
/// rate.
double rate_of(const Json& stream) {
  constexpr double kMost = 120;  // above it, time stamps are only imprecise
  const double exact = ratio_of(stream, "r_frame_rate"),
               average = ratio_of(stream, "avg_frame_rate");
  const double rate = exact > 0 && exact <= kMost ? exact : average;
  return rate > 0 ? std::clamp(rate, kMinFrameRate, kMaxFrameRate) : 24;
}

/// A time in seconds that ffprobe writes as a string.
std::optional<double> time_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  double seconds = 0;
  if (std::sscanf(found->get_ref<const std::string&>().c_str(), "%lf", &seconds) != 1) return {};
  return seconds;
}

Json probed(const Path& file, const std::vector<std::string>& question) {
  std::vector<std::string> words{"ffprobe", "-v", "error"};
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(film_reading_options());
  add(question);
  add({"-of", "json", "file:" + file.string()});
  if (!has_program("ffprobe")) throw Error(ErrorKind::failed, needs(file, "ffprobe"));
  const double start = now_ms();
  constexpr size_t kMostText = size_t{128} << 20;
  const auto answer = run_program(
      words, "", [&] { return now_ms() - start < kPatienceMs; }, kMostText);
  if (!answer) fail(file, "the film could not be examined within a minute");
  Json parsed = Json::parse(answer->output, nullptr, false);
  if (answer->status != 0 || !parsed.is_object())
    fail(file, "not a film in a supported format (MP4, QuickTime, Matroska, WebM or AVI)");
  return parsed;
}

FilmStream probed_stream(const Path& file) {
  read_start(file, 1);  // throws if this is not a readable file
  const Json answer = probed(file, {"-select_streams", "V:0", "-show_entries",
                                    "packet=pts_time,dts_time,flags:stream=codec_name,width,"
                                    "height,avg_frame_rate,r_frame_rate:stream_tags=alpha_mode"});
  const auto streams = answer.find("streams"), packets = answer.find("packets");
  if (streams == answer.end() || streams->empty() || packets == answer.end())
    fail(file, "the file has no pictures that move");
  const Json& stream = streams->front();
  FilmStream film{file, {}};
  film.info.frames_per_second = rate_of(stream);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Json& packet : *packets) {
    if (packet.value("flags", "").find('D') != std::string::npos) continue;  // never shown
    auto time = time_in(packet, "pts_time");
    if (!time) time = time_in(packet, "dts_time");
    if (!time) continue;
    first = std::min(first, *time);
    last = std::max(last, *time);
  }
  if (!(first <= last)) fail(file, "the film has no frames");
  film.info.start = first;
  const double frames = std::round((last - first) * film.info.frames_per_second) + 1;
  check_budget(&Budget::frames, frames, file.string() + ": the film has");
  film.info.frames = static_cast<int>(frames);
  // The usual decoders of these formats leave out the alpha channel.
  const std::string codec = stream.value("codec_name", "");
  const auto tags = stream.find("tags");
  if (tags != stream.end() && tags->value("alpha_mode", "") == "1" &&
      (codec == "vp8" || codec == "vp9"))
    film.decoder = codec == "vp8" ? "libvpx" : "libvpx-vp9";
  PixelBudget alone;
  const auto side = [&](const char* key) {
    const auto found = stream.find(key);
    return found != stream.end() && found->is_number_unsigned() ? found->get<size_t>() : size_t{0};
  };
  alone.take(side("width"), side("height"), file.string());
  const Json sound = probed(file, {"-select_streams", "a:0", "-show_entries", "stream=index"});
  film.info.has_sound = sound.contains("streams") && !sound["streams"].empty();
  return film;
}

/// The command that decodes the frames from `first` on, as a row of PAM pictures.
std::vector<std::string> command_of(const FilmStream& film, int first) {
  char at[48], rate[48], pixels[48];
  std::snprintf(at, sizeof at, "%.9f", film.info.start + first / film.info.frames_per_second);
  std::snprintf(rate, sizeof rate, "%.12g", film.info.frames_per_second);
  std::snprintf(pixels, sizeof pixels, "%.0f", budget().pixels);
  std::vector<std::string> words{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error"};
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(film_reading_options());
  add({"-max_pixels", pixels});
  if (!film.decoder.empty()) add({"-c:v", film.decoder});
  // Time stamps stay those of the file. Decoding starts at the last key frame before the time, and
  // the filter fps leaves out what comes before it. So a stream from the middle of the film has the
  // same frames as one from its start, also where frames have different durations.
  add({"-copyts"});
  if (first > 0) add({"-noaccurate_seek", "-seek_timestamp", "1", "-ss", at});
  add({"-i", "file:" + film.file.string(), "-map", "0:V:0", "-vf",
       std::string("fps=fps=") + rate + ":start_time=" + at +
           ":round=near,scale=trunc(iw*sar+0.5):ih:flags=bicubic+accurate_rnd+full_chroma_int,"
           "setsar=1,format=rgba",
       "-fps_mode", "passthrough", "-c:v", "pam", "-f", "image2pipe", "pipe:1"});
  return words;
}

/// A running ffmpeg, and the number of the frame that it sends next.
class FrameStream {
 public:
  FrameStream(const FilmStream& film, int first)
      : file_(film.file),
        next_(first),
        ffmpeg_(command_of(film, first), needs(film.file, "ffmpeg")) {}

  int next() const { return next_; }
  std::string complaint() const { return ffmpeg_.complaint(); }

  /// The next frame; none after the last one. Throws Error.
  std::optional<Image> read() {
    const std::optional<Image> shape = read_header();
    if (!shape) return {};
    Image image(shape->width, shape->height);
    if (receive(image.pixels.data(), image.pixels.size()) < image.pixels.size()) return {};
    ++next_;
    return image;
  }

 private:
  /// An empty image with the size that a PAM header names.
  std::optional<Image> read_header() {
    constexpr size_t kLongest = 200;
    constexpr std::string_view kEnd = "ENDHDR\n";
    std::string header;
    while (!header.ends_with(kEnd)) {
      char letter = 0;
      if (header.size() == kLongest || receive(&letter, 1) < 1) return {};
      header += letter;
    }
    Image shape;
    int depth = 0;
    if (std::sscanf(header.c_str(), "P7 WIDTH %d HEIGHT %d DEPTH %d", &shape.width, &shape.height,
                    &depth) != 3 ||
        depth != 4 || shape.width < 1 || shape.height < 1)
      fail(file_, "ffmpeg sent a frame in an unknown format");
    PixelBudget alone;
    alone.take(static_cast<size_t>(shape.width), static_cast<size_t>(shape.height), file_.string());
    return shape;
  }

  /// Receives this many bytes, or fewer at the end. Returns how many there were.
  size_t receive(void* into, size_t count) {
    size_t got = 0;
    while (got < count) {
      pollfd wait{ffmpeg_.socket(), POLLIN, 0};
      const int ready = ::poll(&wait, 1, static_cast<int>(kPatienceMs));
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0) fail(file_, "ffmpeg has not decoded a frame for a minute");
      const ssize_t part = ::recv(ffmpeg_.socket(), static_cast<char*>(into) + got, count - got, 0);
      if (part < 0 && errno == EINTR) continue;
      if (part <= 0) break;
      got += static_cast<size_t>(part);
    }
    return got;
  }

  Path file_;
  int next_;
  WatchedProgram ffmpeg_;
};

class Film final : public FrameReader {
 public:
  explicit Film(const Path& file) : film_(probed_stream(file)) {}

  FilmInfo info() const override { return film_.info; }

  Image read(int frame) override {
    if (std::optional<Image> found = read_from(frame, frame)) return std::move(*found);
    // The film may end a little earlier than its time stamps say. Its last frame then stays.
    constexpr int kBefore = 50;
    if (std::optional<Image> found = read_from(std::max(0, frame - kBefore), frame))
      return std::move(*found);
    fail(film_.file, "frame " + std::to_string(frame) + " cannot be decoded" +
                         (complaint_.empty() ? "" : ": " + complaint_));
  }

 private:
  /// A frame, or the last one before it, from a stream that is running or starts at `from`. None if
  /// the stream has ended.
  std::optional<Image> read_from(int from, int frame) {
    const int worth_skipping = static_cast<int>(2 * film_.info.frames_per_second);
    if (!stream_ || frame < stream_->next() || frame > stream_->next() + worth_skipping)
      stream_.emplace(film_, from);
    std::optional<Image> last;
    while (stream_->next() <= frame) {
      std::optional<Image> next = stream_->read();
      if (!next) break;
      last = std::move(next);
    }
    if (!last) {
      complaint_ = stream_->complaint();
      stream_.reset();
    }
    return last;
  }

  FilmStream film_;
  std::string complaint_;  ///< of the stream that ended last
  std::optional<FrameStream> stream_;
};

}  // namespace

std::vector<std::string> film_reading_options() {
  return {"-protocol_whitelist", "file", "-format_whitelist", "mov,mp4,matroska,webm,avi"};
}

std::unique_ptr<FrameReader> open_film(const Path& file) {
  return std::make_unique<Film>(file);
}

}  // namespace holomorph
