// Encodes films with the program ffmpeg. It reads raw frames from a socket, because a write after
// it has died then returns an error instead of raising a signal. It writes to a file that is
// already open, because a file name could redirect its output.
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/error.h"
#include "film/film_writer.h"
#include "raster/compose.h"
#include "system/new_file.h"
#include "system/watched_program.h"

namespace holomorph {
namespace {

constexpr double kPatienceMs = 60000;  ///< how long ffmpeg may make no progress

/// `out` itself, or a file in a new temporary folder if `out` is a pipe.
Path writable_file(const Path& out, std::optional<NewFolder>& folder) {
  if (!is_stream(out)) return out;
  return folder.emplace(std::filesystem::temp_directory_path() / "film").path() / "film";
}

/// A frame rate as ffmpeg reads it: as a ratio with the denominator 1001 if it is one of those of
/// television, such as 30000/1001, also if it was written as 29.97.
std::string ratio_text(double rate) {
  constexpr double kRounded = 2e-6;  // relative
  char text[32];
  const double times = std::round(rate * 1.001) * 1000;
  if (std::abs(times / 1001 - rate) <= kRounded * rate)
    std::snprintf(text, sizeof text, "%.0f/1001", times);
  else
    std::snprintf(text, sizeof text, "%.9g", rate);
  return text;
}

/// A frame with an even width and height. The last column and row are repeated.
Image evened(const Image& frame) {
  const auto even = [](int side) { return side + side % 2; };
  if (even(frame.width) == frame.width && even(frame.height) == frame.height) return frame;
  Image image(even(frame.width), even(frame.height));
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      std::copy_n(frame.at(std::min(column, frame.width - 1), std::min(row, frame.height - 1)), 4,
                  image.at(column, row));
  return image;
}

/// The filter and the options with which colors are converted and marked as those of BT.709, which
/// players expect of films without marks, too.
std::vector<std::string> colors(const std::string& format) {
  return {"-vf",
          "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+"
          "full_chroma_inp,format=" +
              format,
          "-pix_fmt",
          format,
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-color_range",
          "tv"};
}

/// The words of a command that reads raw frames and writes to the passed descriptor. Without
/// -xerror, ffmpeg reports success if only the end of the file could not be written.
std::vector<std::string> command_of(const FilmShape& shape, const std::vector<std::string>& codec) {
  std::vector<std::string> words{"ffmpeg",
                                 "-nostdin",
                                 "-xerror",
                                 "-hide_banner",
                                 "-v",
                                 "error",
                                 "-y",
                                 "-f",
                                 "rawvideo",
                                 "-pixel_format",
                                 "rgba",
                                 "-video_size",
                                 std::to_string(shape.width) + "x" + std::to_string(shape.height),
                                 "-framerate",
                                 ratio_text(shape.frames_per_second),
                                 "-i",
                                 "pipe:0"};
  const SoundArguments sound = sound_arguments(shape.sound, shape.seconds);
  words.insert(words.end(), sound.inputs.begin(), sound.inputs.end());
  words.insert(words.end(), sound.filters.begin(), sound.filters.end());
  words.insert(words.end(), codec.begin(), codec.end());
  words.push_back("file:/dev/fd/" + std::to_string(kPassedDescriptor));
  return words;
}

class FfmpegWriter final : public FilmWriter {
 public:
  FfmpegWriter(const Path& out, const FilmShape& shape, const std::vector<std::string>& codec,
               bool opaque)
      : out_(out),
        film_(writable_file(out, folder_)),
        opaque_(opaque),
        ffmpeg_(command_of(shape, codec),
                "films of type " + out.extension().string() +
                    " need the program ffmpeg, which is not installed; install it, or choose "
                    ".webp, .gif, .apng or .png",
                film_.descriptor()) {}

  void add(const Image& frame) override {
    Image flat = frame;
    if (opaque_) {
      composite_onto_color(flat, {255, 255, 255});
      flat = evened(flat);
    }
    for (size_t sent = 0; sent < flat.pixels.size();) {
      if (!ffmpeg_.accepts(kPatienceMs)) fail();
      const ssize_t count = ::send(ffmpeg_.socket(), flat.pixels.data() + sent,
                                   flat.pixels.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (count <= 0) fail();
      sent += static_cast<size_t>(count);
    }
  }

  void finish() override {
    if (ffmpeg_.end(kPatienceMs) != 0) fail();
    if (!is_stream(out_)) return film_.put_in_place();
    const Path film = "/dev/fd/" + std::to_string(film_.descriptor());
    write_file(out_, read_stream(film, std::numeric_limits<size_t>::max()));
  }

 private:
  [[noreturn]] void fail() {
    ffmpeg_.end(kPatienceMs);
    const std::string complaint = ffmpeg_.complaint();
    throw Error(ErrorKind::failed,
                out_.string() + ": ffmpeg " +
                    (ffmpeg_.was_stuck() ? "made no progress for a minute" : "failed") +
                    (complaint.empty() ? "" : ": " + complaint));
  }

  Path out_;
  std::optional<NewFolder> folder_;  ///< only for pipes, because ffmpeg must seek in its output
  NewFile film_;
  bool opaque_;
  WatchedProgram ffmpeg_;
};

}  // namespace

std::unique_ptr<FilmWriter> mp4_writer(const Path& out, const FilmShape& shape) {
  std::vector<std::string> words = colors("yuv420p");
  words.insert(words.end(), {"-c:v", "libx264", "-crf", "17", "-c:a", "aac", "-b:a", "192k",
                             "-movflags", "+faststart", "-f", "mp4"});
  // H.264 in its usual form needs an even width and height.
  FilmShape even = shape;
  even.width += shape.width % 2;
  even.height += shape.height % 2;
  return std::make_unique<FfmpegWriter>(out, even, words, true);
}

std::unique_ptr<FilmWriter> webm_writer(const Path& out, const FilmShape& shape) {
  std::vector<std::string> words = colors("yuva420p");
  words.insert(words.end(), {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "24", "-auto-alt-ref", "0",
                             "-c:a", "libopus", "-b:a", "128k", "-f", "webm"});
  return std::make_unique<FfmpegWriter>(out, shape, words, false);
}

}  // namespace holomorph
