// The table of formats, and the one that needs no encoder.
#include "film/film_writer.h"

#include <algorithm>

#include "core/error.h"

namespace holomorph {
namespace {

class PngFrames final : public FilmWriter {
 public:
  explicit PngFrames(const Path& out) : out_(out) {}
  ~PngFrames() override {
    for (const Path& path : written_) {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
    }
  }
  void add(const Image& frame) override {
    const Path path = numbered(out_, static_cast<int>(written_.size()));
    write_file(path, encode_png(frame));
    written_.push_back(path);
  }
  void finish() override { written_.clear(); }

 private:
  Path out_;
  std::vector<Path> written_;
};

}  // namespace

Path numbered(const Path& path, int frame) {
  char number[16];
  std::snprintf(number, sizeof number, "-%04d", frame);
  Path result = path;
  result.replace_filename(path.stem().string() + number + path.extension().string());
  return result;
}

std::unique_ptr<FilmWriter> png_frames_writer(const Path& out, const FilmShape&) {
  return std::make_unique<PngFrames>(out);
}

const std::vector<FilmFormat>& film_formats() {
  static const std::vector<FilmFormat> formats{
      {".webp", "Animated WebP", false, webp_writer},
      {".gif", "GIF", false, gif_writer},
      {".apng", "Animated PNG", false, apng_writer},
      {".png", "PNG files, one for each frame", false, png_frames_writer},
      {".mp4", "MP4 (H.264)", true, mp4_writer},
      {".webm", "WebM (VP9)", true, webm_writer}};
  return formats;
}

const FilmFormat& film_format_of(const Path& path) {
  const std::string extension = lower_case(path.extension().string());
  std::string known;
  for (const FilmFormat& format : film_formats()) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + format.extension;
  }
  throw Error(ErrorKind::bad_input, path.string() + ": films are of one of these kinds: " + known);
}

}  // namespace holomorph
