// Reads films frame by frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/formats/image.h"

namespace holomorph {

/// What is known about a film before its frames are decoded.
struct FilmInfo {
  int frames = 0;
  double frames_per_second = 24;
  bool has_sound = false;
  double start = 0;     ///< the time stamp of the first frame, in seconds
  bool is_hdr = false;  ///< colors are brighter than those of screens, and are toned down
};

/// An open film. Frames are numbered from 0 and have equal durations.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  virtual FilmInfo info() const = 0;
  /// Decodes a frame, upright and with 8 bits per channel. Throws Error{bad_input}. The frame after
  /// the one that was read last is the fastest to read.
  virtual Image read(int frame) = 0;
  /// Makes read() throw Error soon, also one that is running on another thread.
  virtual void cancel() {}
};

/// Opens a film through the programs ffprobe and ffmpeg. Frame i is what a player shows at i /
/// frames_per_second seconds after the first frame, whatever the durations of the file's own frames
/// are. Only the file itself is read, even if it names others. Throws Error: bad_input if the file
/// is not a film, failed if ffmpeg is not installed. Cost: reads the whole file once.
std::unique_ptr<FrameReader> open_film(const Path& file);

/// Options for ffmpeg and ffprobe, before a film is named. They allow only containers that do not
/// have other files or addresses read.
std::vector<std::string> film_reading_options();

/// The first frame of a film, without examining the rest. Throws Error like open_film().
Image first_frame_of_film(const Path& file);

}  // namespace holomorph
