// Encodes films with the program ffmpeg. It reads raw frames from a socket, because a write after
// it has died then returns an error instead of raising a signal. It writes to a file that is
// already open, because a file name could redirect its output.
#include <sys/socket.h>

#include <cerrno>
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

/// `out` itself, or a file in a new temporary folder if `out` is a pipe.
Path writable_file(const Path& out, std::optional<NewFolder>& folder) {
  if (!is_stream(out)) return out;
  return folder.emplace(std::filesystem::temp_directory_path() / "film").path() / "film";
}

/// The words of a command that reads raw frames and writes to the passed descriptor. Without
/// -xerror, ffmpeg reports success if only the end of the file could not be written.
std::vector<std::string> command_of(const FilmShape& shape, const std::vector<std::string>& codec) {
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.6g", shape.frames_per_second);
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
                                 rate,
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
    if (opaque_) composite_onto_color(flat, {255, 255, 255});
    for (size_t sent = 0; sent < flat.pixels.size();) {
      const ssize_t count = ::send(ffmpeg_.socket(), flat.pixels.data() + sent,
                                   flat.pixels.size() - sent, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail();
      sent += static_cast<size_t>(count);
    }
  }

  void finish() override {
    if (ffmpeg_.end() != 0) fail();
    if (!is_stream(out_)) return film_.put_in_place();
    const Path film = "/dev/fd/" + std::to_string(film_.descriptor());
    write_file(out_, read_stream(film, std::numeric_limits<size_t>::max()));
  }

 private:
  [[noreturn]] void fail() {
    ffmpeg_.end();
    const std::string complaint = ffmpeg_.complaint();
    throw Error(ErrorKind::failed,
                out_.string() + ": ffmpeg failed" + (complaint.empty() ? "" : ": " + complaint));
  }

  Path out_;
  std::optional<NewFolder> folder_;  ///< only for pipes, because ffmpeg must seek in its output
  NewFile film_;
  bool opaque_;
  WatchedProgram ffmpeg_;
};

}  // namespace

std::unique_ptr<FilmWriter> mp4_writer(const Path& out, const FilmShape& shape) {
  // H.264 in its usual form needs an even width and height.
  return std::make_unique<FfmpegWriter>(
      out, shape,
      std::vector<std::string>{"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v",
                               "libx264", "-crf", "17", "-pix_fmt", "yuv420p", "-c:a", "aac",
                               "-b:a", "192k", "-movflags", "+faststart", "-f", "mp4"},
      true);
}

std::unique_ptr<FilmWriter> webm_writer(const Path& out, const FilmShape& shape) {
  return std::make_unique<FfmpegWriter>(
      out, shape,
      std::vector<std::string>{"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "24", "-pix_fmt",
                               "yuva420p", "-auto-alt-ref", "0", "-c:a", "libopus", "-b:a", "128k",
                               "-f", "webm"},
      false);
}

}  // namespace holomorph
