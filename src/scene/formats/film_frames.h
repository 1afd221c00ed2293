// Reads films and numbered pictures frame by frame.
#pragma once

#include <memory>
#include <vector>

#include "scene/formats/image.h"

namespace holomorph {

/// What is known about a film before its frames are decoded.
struct FilmInfo {
  int frames = 0;
  double frames_per_second = 24;
  bool has_sound = false;
  double start = 0;  ///< the time stamp of the first frame, in seconds
};

/// An open film. Frames are numbered from 0 and have equal durations.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  virtual FilmInfo info() const = 0;
  /// Decodes a frame, upright and in sRGB. Throws Error{bad_input}. The frame after the one that
  /// was read last is the fastest to read.
  virtual Image read(int frame) = 0;
};

/// Opens a film through the programs ffprobe and ffmpeg. Frame i is what a player shows at i /
/// frames_per_second seconds after the first frame, whatever the durations of the file's own frames
/// are. Only the file itself is read, even if it names others. Throws Error: bad_input if the file
/// is not a film, failed if ffmpeg is not installed. Cost: reads the whole file once.
std::unique_ptr<FrameReader> open_film(const Path& file);

/// Options for ffmpeg and ffprobe, before a film is named, that keep it from having other files or
/// addresses read.
std::vector<std::string> film_reading_options();

/// Opens pictures whose names end with successive numbers, beginning with this one. Throws
/// Error{bad_input} if its name does not end with a number.
std::unique_ptr<FrameReader> open_numbered_pictures(const Path& first);
/// The files of these pictures: this one, and those with the numbers after it up to the first gap.
/// Empty if the file's name does not end with a number.
std::vector<Path> numbered_pictures(const Path& first);
/// Whether there is a picture with the number before or after this one's.
bool has_numbered_neighbor(const Path& file);
/// The first of the pictures with successive numbers to which this one belongs.
Path first_numbered_picture(const Path& any);

}  // namespace holomorph
