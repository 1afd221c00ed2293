// Films as files: frames are added one after another, and the file is there when all are.
#pragma once

#include <memory>

#include "scene/formats/image.h"

namespace holomorph {

/// How many frames a second, and of which size.
struct FilmShape {
  int width = 0, height = 0;
  double frames_per_second = 24;
  bool loops = true;  ///< where the format knows
};

/// Destroyed before finish(), nothing of the film remains.
class FilmWriter {
 public:
  virtual ~FilmWriter() = default;
  /// The frame must have the film's size. Throws Error.
  virtual void add(const Image& frame) = 0;
  /// Throws Error, and leaves nothing then.
  virtual void finish() = 0;
};

struct FilmFormat {
  std::string extension, label;
  bool needs_ffmpeg = false;
  std::unique_ptr<FilmWriter> (*open)(const Path& out, const FilmShape& shape) = nullptr;
};

/// Every format, the default one first: animated WebP, GIF, APNG, numbered PNG files, MP4 and WebM.
const std::vector<FilmFormat>& film_formats();
/// By a path's extension; throws Error naming those that exist.
const FilmFormat& film_format_of(const Path& path);

/// walk.png and 7: walk-0007.png.
Path numbered(const Path& path, int frame);
/// The files that a film of so many frames is written to.
std::vector<Path> files_of_film(const Path& out, int frames);

std::unique_ptr<FilmWriter> webp_writer(const Path& out, const FilmShape& shape);
/// 256 colours chosen for each frame; pixels are transparent or not.
std::unique_ptr<FilmWriter> gif_writer(const Path& out, const FilmShape& shape);
std::unique_ptr<FilmWriter> apng_writer(const Path& out, const FilmShape& shape);
/// A file for each frame, by `numbered`.
std::unique_ptr<FilmWriter> png_frames_writer(const Path& out, const FilmShape& shape);
/// By the program ffmpeg, fed with raw frames; transparency becomes white. Throws Error where it is
/// not installed.
std::unique_ptr<FilmWriter> mp4_writer(const Path& out, const FilmShape& shape);
/// The same with transparency (VP9).
std::unique_ptr<FilmWriter> webm_writer(const Path& out, const FilmShape& shape);

}  // namespace holomorph
