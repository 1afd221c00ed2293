// Contains the table of formats and the writer of numbered PNG files, the only format that needs no
// film encoder.
#include "film/film_writer.h"

#include <algorithm>

#include "core/error.h"
#include "film/ordered_tasks.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Collects the frames in a temporary folder. Existing files with the names of frames are replaced
/// only after all frames have been written.
class PngFrames final : public FilmWriter {
 public:
  explicit PngFrames(const Path& out) : out_(out), staging_(out) {}
  void add(const Image& frame) override {
    files_.add([path = staged_file(frames_), frame] {
      write_file(path, encode_png(frame));
      return path;
    });
    ++frames_;
  }
  void finish() override {
    files_.finish();
    for (int i = 0; i < frames_; ++i)
      if (std::filesystem::is_directory(numbered(out_, i)))
        throw Error(ErrorKind::failed,
                    numbered(out_, i).string() +
                        ": this is a folder; move it, or choose another name for the frames");
    for (int i = 0; i < frames_; ++i) move_file(staged_file(i), numbered(out_, i));
  }

 private:
  Path staged_file(int frame) const { return staging_.path() / std::to_string(frame); }

  Path out_;
  NewFolder staging_;
  int frames_ = 0;
  OrderedTasks<Path> files_{[](const Path&) {}};
};

}  // namespace

Path numbered(const Path& path, int frame) {
  char number[16];
  std::snprintf(number, sizeof number, "-%04d", frame);
  Path result = path;
  result.replace_filename(path.stem().string() + number + path.extension().string());
  return result;
}

std::vector<Path> files_of_film(const Path& out, int frames) {
  if (lower_case(out.extension().string()) != ".png") return {out};
  std::vector<Path> files;
  for (int i = 0; i < frames; ++i) files.push_back(numbered(out, i));
  return files;
}

std::unique_ptr<FilmWriter> png_frames_writer(const Path& out, const FilmShape&) {
  return std::make_unique<PngFrames>(out);
}

const std::vector<FilmFormat>& film_formats() {
  static const std::vector<FilmFormat> formats{
      {".webp", "Animated WebP", false, false, webp_writer},
      {".gif", "GIF", false, false, gif_writer},
      {".apng", "Animated PNG", false, false, apng_writer},
      {".png", "PNG files, one per frame", false, false, png_frames_writer},
      {".mp4", "MP4 (H.264)", true, true, mp4_writer},
      {".webm", "WebM (VP9)", true, true, webm_writer}};
  return formats;
}

const FilmFormat& film_format_of(const Path& path) {
  const std::string extension = lower_case(path.extension().string());
  std::string known;
  for (const FilmFormat& format : film_formats()) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + format.extension;
  }
  throw Error(ErrorKind::bad_input,
              path.string() + ": this is not a film format; end the name with one of " + known);
}

}  // namespace holomorph
