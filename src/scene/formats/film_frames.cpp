// Decodes films with the program ffmpeg. A stream of frames starts where one was asked for and is
// read as long as later frames are asked for; then it is cheaper than a new stream.
#include "scene/formats/film_frames.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

#include "core/clock.h"
#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/json_reader.h"
#include "scene/limits.h"
#include "system/text.h"
#include "system/watched_program.h"

namespace holomorph {
namespace {

constexpr double kPatienceMs = 60000;  ///< how long ffmpeg may take for its next answer

/// A frame at which decoding can start.
struct KeyFrame {
  double shown;   ///< its time stamp
  double stored;  ///< a time that finds it, and not a later one, in the film's index
};

/// What the decoder needs to know about a film.
/// What players take for high definition.
constexpr size_t kLeastHdWidth = 1280, kMostSdHeight = 576;

struct ProbedFilm {
  Path file;
  FilmInfo info;
  std::string decoder = {};         ///< empty: the usual one
  bool is_untagged_hd = false;      ///< a large film that does not say how it stores colors
  std::vector<KeyFrame> keys = {};  ///< in the order in which they are shown
};

std::string needs(const Path& file, const std::string& program) {
  return file.string() + ": films need the program " + program +
         ", which is not installed; install the package ffmpeg";
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

[[noreturn]] void fail(const Path& file, const std::string& why) {
  throw Error(ErrorKind::bad_input, file.string() + ": " + why);
}

/// Frames must fit into memory several times.
void check_frame_size(size_t width, size_t height, const Path& file) {
  constexpr double kMostPixels = 64e6;
  PixelBudget().take(width, height, file.string());
  if (static_cast<double>(width) * static_cast<double>(height) > kMostPixels)
    fail(file, "its frames have more than 64 megapixels");
}

/// The number at the start of a text, in any locale; none if there is none.
std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  return wrong == std::errc{} ? std::optional(value) : std::nullopt;
}

/// A ratio such as "30000/1001"; 0 if it is not one.
double ratio_of(const Json& object, const char* key) {
  const std::string text = object.value(key, "");
  const size_t slash = text.find('/');
  if (slash == std::string::npos) return 0;
  const auto numerator = number_in(text),
             denominator = number_in(std::string_view(text).substr(slash + 1));
  return numerator && denominator && *denominator > 0 ? *numerator / *denominator : 0;
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

/// What ffprobe writes about a film.
std::string probed(const Path& file, const std::vector<std::string>& question) {
  std::vector<std::string> words{"ffprobe", "-v", "error"};
  append(words, film_reading_options());
  append(words, question);
  words.push_back("file:" + file.string());
  if (!has_program("ffprobe")) throw Error(ErrorKind::failed, needs(file, "ffprobe"));
  const double start = now_ms();
  const auto answer = run_program(words, "",
                                  {.keep_running = [&] { return now_ms() - start < kPatienceMs; },
                                   .most_output = size_t{32} << 20,
                                   .limits = reader_limits()});
  if (!answer) fail(file, "it takes more than a minute, or 32 MB, to list the film's frames");
  if (answer->out_of_time)
    fail(file, "listing the film's frames takes too long; the limit is " +
                   limit_text(&Budget::reader_seconds));
  if (answer->status != 0)
    fail(file, "not a film in a supported format (MP4, QuickTime, Matroska, WebM or AVI)");
  return answer->output;
}

/// Finds the first and the last time stamp of the frames, and the key frames.
void measure_times(ProbedFilm& film) {
  std::istringstream lines(
      probed(film.file, {"-select_streams", "V:0", "-show_entries",
                         "packet=pts_time,dts_time,flags", "-of", "csv=print_section=0"}));
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (std::string line; std::getline(lines, line);) {
    const size_t comma = line.find(','), flags = line.rfind(',');
    if (comma == std::string::npos || line.find('D', flags) != std::string::npos) continue;
    const auto shown = number_in(line),
               decoded = number_in(std::string_view(line).substr(comma + 1));
    const auto time = shown ? shown : decoded;
    if (!time) continue;
    first = std::min(first, *time);
    last = std::max(last, *time);
    // Some formats are searched by the times at which frames are decoded. A key frame may be
    // decoded before earlier frames are shown.
    if (line.find('K', flags) != std::string::npos)
      film.keys.push_back({*time, decoded ? std::min(*time, *decoded) : *time});
  }
  std::ranges::sort(film.keys, {}, &KeyFrame::shown);
  if (!(first <= last)) fail(film.file, "the film has no frames");
  film.info.start = first;
  const double frames = std::round((last - first) * film.info.frames_per_second) + 1;
  check_budget(&Budget::frames, frames, film.file.string() + ": the film has");
  film.info.frames = static_cast<int>(frames);
}

/// Whether a stream is a film, and not a picture of the cover.
bool is_video(const Json& stream) {
  const auto disposition = stream.find("disposition");
  return stream.value("codec_type", "") == "video" &&
         !(disposition != stream.end() && disposition->value("attached_pic", 0) == 1);
}

ProbedFilm probed_film(const Path& file) {
  read_start(file, 1);  // throws if this is not a readable file
  const Json answer = Json::parse(
      probed(file, {"-show_entries",
                    "stream=codec_type,codec_name,width,height,avg_frame_rate,r_frame_rate,"
                    "color_space,color_transfer:"
                    "stream_disposition=attached_pic:stream_tags=alpha_mode",
                    "-of", "json"}),
      nullptr, false);
  if (!answer.is_object() || !answer.contains("streams")) fail(file, "the file has no video");
  const Json& streams = answer["streams"];
  const auto video = std::ranges::find_if(streams, is_video);
  if (video == streams.end()) fail(file, "the file has no video");
  const auto side = [&](const char* key) {
    const auto found = video->find(key);
    return found != video->end() && found->is_number_unsigned() ? found->get<size_t>() : size_t{0};
  };
  check_frame_size(side("width"), side("height"), file);
  ProbedFilm film{file, {}};
  film.info.frames_per_second = rate_of(*video);
  film.info.has_sound = std::ranges::any_of(
      streams, [](const Json& stream) { return stream.value("codec_type", "") == "audio"; });
  // The usual decoders of these formats leave out the alpha channel.
  const std::string codec = video->value("codec_name", "");
  const auto tags = video->find("tags");
  if (tags != video->end() && tags->value("alpha_mode", "") == "1" &&
      (codec == "vp8" || codec == "vp9"))
    film.decoder = codec == "vp8" ? "libvpx" : "libvpx-vp9";
  const std::string transfer = video->value("color_transfer", ""),
                    matrix = video->value("color_space", "unknown");
  film.info.is_hdr = transfer == "smpte2084" || transfer == "arib-std-b67";
  film.is_untagged_hd =
      matrix == "unknown" && (side("width") >= kLeastHdWidth || side("height") > kMostSdHeight);
  measure_times(film);
  return film;
}

/// Frames as PAM pictures, with square pixels.
std::string conversion(const std::string& matrix = "") {
  return "scale=trunc(iw*sar+0.5):ih:flags=bicubic+accurate_rnd+full_chroma_int" + matrix +
         ",setsar=1,format=rgba";
}

/// Also shows the colors of HDR films in sRGB: white is that of a page (203 cd/m2, ITU-R BT.2408),
/// and from 60 % of it on, light is compressed. In large films that do not say how they store
/// colors, it is as BT.709 says, and as players assume.
std::string conversion_of(const ProbedFilm& film) {
  if (film.info.is_hdr)
    return "zscale=transfer=linear:npl=203,format=gbrpf32le,zscale=primaries=bt709,"
           "tonemap=mobius:param=0.6:desat=0,zscale=transfer=iec61966-2-1:matrix=gbr:range=full,"
           "format=gbrp," +
           conversion();
  return conversion(film.is_untagged_hd ? ":in_color_matrix=bt709" : "");
}
const std::vector<std::string> kOutput{"-c:v", "pam", "-f", "image2pipe", "pipe:1"};

std::vector<std::string> decoding_command() {
  std::vector<std::string> words{"ffmpeg", "-nostdin", "-hide_banner", "-v", "error"};
  append(words, film_reading_options());
  return words;
}

/// The command that decodes the frames from `first` on.
std::vector<std::string> command_of(const ProbedFilm& film, int first) {
  const double start = film.info.start + first / film.info.frames_per_second;
  const std::string at = decimal(start, 9);
  std::vector<std::string> words = decoding_command();
  if (!film.decoder.empty()) append(words, {"-c:v", film.decoder});
  // Time stamps stay those of the file. Decoding starts at the last key frame before the time, and
  // the filter fps leaves out what comes before it. So a stream from the middle of the film has the
  // same frames as one from its start, also where frames have different durations.
  append(words, {"-copyts"});
  const auto after = std::ranges::upper_bound(film.keys, start, {}, &KeyFrame::shown);
  if (first > 0 && after != film.keys.begin())
    append(words, {"-noaccurate_seek", "-seek_timestamp", "1", "-ss",
                   decimal(std::prev(after)->stored, 9)});
  append(words, {"-i", "file:" + film.file.string(), "-map", "0:V:0", "-vf",
                 "fps=fps=" + decimal(film.info.frames_per_second, 9) + ":start_time=" + at +
                     ":round=near," + conversion_of(film),
                 "-fps_mode", "passthrough"});
  append(words, kOutput);
  return words;
}

/// A running ffmpeg, and the number of the frame that it sends next.
class FrameStream {
 public:
  /// Reading stops soon after `canceled` becomes true; it must outlive the stream.
  FrameStream(const Path& file, const std::vector<std::string>& command, int first,
              const std::atomic<bool>& canceled)
      : file_(file), next_(first), canceled_(canceled), ffmpeg_(command, needs(file, "ffmpeg")) {}

  int next() const { return next_; }
  std::string complaint() const { return ffmpeg_.complaint(); }
  /// Whether the stream has ended because ffmpeg took too long. Ends it.
  bool out_of_time() {
    ffmpeg_.end();
    return ffmpeg_.out_of_time();
  }

  /// The next frame; none after the last one. Throws Error.
  std::optional<Image> read() {
    ffmpeg_.limit(reader_limits());
    const std::optional<Image> shape = read_header();
    if (!shape) return {};
    Image image(shape->width, shape->height);
    if (receive(image.pixels.data(), image.pixels.size()) < image.pixels.size()) return {};
    ++next_;
    return image;
  }

 private:
  /// An empty image with the size that a PAM header states.
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
    check_frame_size(static_cast<size_t>(shape.width), static_cast<size_t>(shape.height), file_);
    return shape;
  }

  /// Receives this many bytes, or fewer at the end. Returns how many there were.
  size_t receive(void* into, size_t count) {
    size_t got = 0;
    while (got < count) {
      wait();
      const ssize_t part = ::recv(ffmpeg_.socket(), static_cast<char*>(into) + got, count - got, 0);
      if (part < 0 && errno == EINTR) continue;
      if (part <= 0) break;
      got += static_cast<size_t>(part);
    }
    return got;
  }

  /// Waits until there is something to receive.
  void wait() const {
    constexpr int kStepMs = 50;
    const double start = now_ms();
    for (pollfd waiting{ffmpeg_.socket(), POLLIN, 0}; ::poll(&waiting, 1, kStepMs) <= 0;) {
      if (canceled_) throw Error(ErrorKind::failed, file_.string() + ": reading was canceled");
      if (now_ms() - start > kPatienceMs) fail(file_, "ffmpeg has not sent a frame for a minute");
    }
  }

  Path file_;
  int next_;
  const std::atomic<bool>& canceled_;
  WatchedProgram ffmpeg_;
};

class Film final : public FrameReader {
 public:
  explicit Film(const Path& file) : film_(probed_film(file)) {}

  FilmInfo info() const override { return film_.info; }
  void cancel() override { canceled_ = true; }

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
      stream_.emplace(film_.file, command_of(film_, from), from, canceled_);
    std::optional<Image> last;
    while (stream_->next() <= frame) {
      std::optional<Image> next = stream_->read();
      if (!next) break;
      last = std::move(next);
    }
    if (!last) {
      if (stream_->out_of_time())
        fail(film_.file, "decoding frame " + std::to_string(frame) +
                             " takes too long; the limit is " +
                             limit_text(&Budget::reader_seconds));
      complaint_ = stream_->complaint();
      stream_.reset();
    }
    return last;
  }

  ProbedFilm film_;
  std::string complaint_;  ///< of the stream that ended last
  std::atomic<bool> canceled_ = false;
  std::optional<FrameStream> stream_;
};

}  // namespace

std::vector<std::string> film_reading_options() {
  return {"-protocol_whitelist", "file", "-format_whitelist", "mov,mp4,matroska,webm,avi"};
}

std::unique_ptr<FrameReader> open_film(const Path& file) {
  return std::make_unique<Film>(file);
}

Image first_frame_of_film(const Path& file) {
  read_start(file, 1);
  std::vector<std::string> words = decoding_command();
  append(words,
         {"-i", "file:" + file.string(), "-map", "0:V:0", "-frames:v", "1", "-vf", conversion()});
  append(words, kOutput);
  const std::atomic<bool> canceled = false;
  if (std::optional<Image> first = FrameStream(file, words, 0, canceled).read())
    return std::move(*first);
  fail(file, "not a film in a supported format");
}

}  // namespace holomorph
