// Encodes films with the program ffmpeg. It reads raw frames from a socket, because a write after
// it has died then returns an error instead of raising a signal. It writes to a file that is
// already open, because a file name could redirect its output.
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "film/film_writer.h"
#include "raster/compose.h"
#include "system/new_file.h"
#include "system/process.h"

namespace holomorph {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// `out` itself, or a file in a new temporary folder if `out` is a pipe.
Path writable_file(const Path& out, std::optional<NewFolder>& folder) {
  if (!is_stream(out)) return out;
  return folder.emplace(std::filesystem::temp_directory_path() / "film").path() / "film";
}

class FfmpegWriter final : public FilmWriter {
 public:
  FfmpegWriter(const Path& out, const FilmShape& shape, std::vector<std::string> codec, bool opaque)
      : out_(out), film_(writable_file(out, folder_)), opaque_(opaque) {
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.6g", shape.frames_per_second);
    std::vector<std::string> words{"ffmpeg",
                                   "-nostdin",
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
    words.insert(words.end(), codec.begin(), codec.end());
    words.push_back("file:/dev/fd/" + std::to_string(kPassedDescriptor));
    start(words);
  }
  ~FfmpegWriter() override {
    if (child_.pid > 0) ::kill(child_.pid, SIGKILL);
    end();
  }

  void add(const Image& frame) override {
    Image flat = frame;
    if (opaque_) composite_onto_color(flat, {255, 255, 255});
    for (size_t sent = 0; sent < flat.pixels.size();) {
      const ssize_t count =
          ::send(child_.socket, flat.pixels.data() + sent, flat.pixels.size() - sent, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail();
      sent += static_cast<size_t>(count);
    }
  }

  void finish() override {
    if (end() != 0) fail();
    if (!is_stream(out_)) return film_.put_in_place();
    const Path film = "/dev/fd/" + std::to_string(film_.descriptor());
    write_file(out_, read_stream(film, std::numeric_limits<size_t>::max()));
  }

 private:
  void start(const std::vector<std::string>& words) {
    if (!log_) throw Error(ErrorKind::failed, "cannot create a temporary file for ffmpeg");
    if (const auto child = start_program(words, ::fileno(log_.get()), film_.descriptor())) {
      child_ = *child;
      return;
    }
    if (errno != ENOENT)
      throw Error(ErrorKind::failed, std::string("cannot start ffmpeg: ") + std::strerror(errno));
    throw Error(ErrorKind::failed,
                "films of type " + out_.extension().string() +
                    " need the program ffmpeg, which is not installed; install it, or "
                    "choose .webp, .gif, .apng or .png");
  }

  /// Waits until ffmpeg ends, and returns its exit status.
  int end() {
    if (child_.socket >= 0) ::close(std::exchange(child_.socket, -1));
    if (child_.pid <= 0) return status_;
    int status = 0;
    ::waitpid(std::exchange(child_.pid, 0), &status, 0);
    return status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }

  [[noreturn]] void fail() {
    end();
    std::rewind(log_.get());
    std::array<char, 400> line{};
    const std::string all =
        std::fgets(line.data(), static_cast<int>(line.size()), log_.get()) ? line.data() : "";
    const std::string message = all.substr(0, all.find('\n'));
    throw Error(ErrorKind::failed,
                out_.string() + ": ffmpeg failed" + (message.empty() ? "" : ": " + message));
  }

  Path out_;
  std::optional<NewFolder> folder_;  ///< only for pipes, because ffmpeg must seek in its output
  NewFile film_;
  bool opaque_;
  std::unique_ptr<std::FILE, Close> log_{std::tmpfile()};  ///< unnamed file of ffmpeg's messages
  Child child_;
  int status_ = 0;
};

}  // namespace

std::unique_ptr<FilmWriter> mp4_writer(const Path& out, const FilmShape& shape) {
  // H.264 in its usual form needs an even width and height.
  return std::make_unique<FfmpegWriter>(
      out, shape,
      std::vector<std::string>{"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v",
                               "libx264", "-crf", "17", "-pix_fmt", "yuv420p", "-movflags",
                               "+faststart", "-f", "mp4"},
      true);
}

std::unique_ptr<FilmWriter> webm_writer(const Path& out, const FilmShape& shape) {
  return std::make_unique<FfmpegWriter>(
      out, shape,
      std::vector<std::string>{"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "24", "-pix_fmt",
                               "yuva420p", "-auto-alt-ref", "0", "-f", "webm"},
      false);
}

}  // namespace holomorph
