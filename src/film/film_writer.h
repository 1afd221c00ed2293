// Film formats. Frames are added one by one, and the file appears when the film is finished.
#pragma once

#include <memory>

#include "film/sound.h"

namespace holomorph {

/// The size and the frame rate of a film.
struct FilmShape {
  int width = 0, height = 0;
  double frames_per_second = 24;
  bool loops = true;   ///< if the format supports it
  double seconds = 0;  ///< its length; needed only with sound
  std::vector<SoundTrack> sound = {};
};

/// Writes one film. If it is destroyed before finish(), nothing of the film remains.
class FilmWriter {
 public:
  virtual ~FilmWriter() = default;
  /// Appends a frame, which must have the film's size. Throws Error.
  virtual void add(const Image& frame) = 0;
  /// Completes the file. If that fails, leaves no file and throws Error.
  virtual void finish() = 0;
};

struct FilmFormat {
  std::string extension, label;
  bool needs_ffmpeg = false;
  bool can_have_sound = false;
  std::unique_ptr<FilmWriter> (*open)(const Path& out, const FilmShape& shape) = nullptr;
};

/// All formats, the default one first: animated WebP, GIF, APNG, numbered PNG files, MP4 and WebM.
const std::vector<FilmFormat>& film_formats();
/// The format that a path's extension selects. If there is none, throws Error with a list of the
/// known extensions.
const FilmFormat& film_format_of(const Path& path);

/// The name of a frame's file: walk-0007.png for walk.png and frame 7.
Path numbered(const Path& path, int frame);
/// The files that a film with this number of frames is written to.
std::vector<Path> files_of_film(const Path& out, int frames);

std::unique_ptr<FilmWriter> webp_writer(const Path& out, const FilmShape& shape);
/// 256 colors chosen for each frame. Each pixel is either opaque or fully transparent.
std::unique_ptr<FilmWriter> gif_writer(const Path& out, const FilmShape& shape);
std::unique_ptr<FilmWriter> apng_writer(const Path& out, const FilmShape& shape);
/// One file per frame, named by `numbered`.
std::unique_ptr<FilmWriter> png_frames_writer(const Path& out, const FilmShape& shape);
/// Encodes H.264 with the program ffmpeg. Transparent pixels are composited onto white. Throws
/// Error if ffmpeg is not installed.
std::unique_ptr<FilmWriter> mp4_writer(const Path& out, const FilmShape& shape);
/// Like mp4_writer, but encodes VP9 and keeps transparency.
std::unique_ptr<FilmWriter> webm_writer(const Path& out, const FilmShape& shape);

}  // namespace holomorph
