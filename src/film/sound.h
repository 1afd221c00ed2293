// The sound of films that are pictures of a scene, for films that are written.
#pragma once

#include <string>
#include <vector>

#include "scene/pictures.h"

namespace holomorph {

/// A part of the sound of a film file, and when it is heard.
struct SoundTrack {
  Path file;
  double from = 0, length = 0;  ///< the part, in seconds of the file's time stamps
  double speed = 1;             ///< how much faster it is played than recorded
  double start = 0;             ///< when it starts in the new film, in seconds; may be negative
  bool loops = false;
  bool operator==(const SoundTrack&) const = default;
};

/// The sound of the films in a scene's visible layers. `zero` is the time of the new film's first
/// frame.
std::vector<SoundTrack> sound_of(const Scene& scene, const Pictures& pictures, double zero);

/// Whether sound_of() finds any.
bool has_sound(const Scene& scene, const Pictures& pictures);

/// The arguments of ffmpeg that add sound to a film of this length in seconds whose frames are its
/// first input: what opens the files, and what follows all inputs. Both are empty without tracks.
struct SoundArguments {
  std::vector<std::string> inputs, filters;
};
SoundArguments sound_arguments(const std::vector<SoundTrack>& tracks, double seconds);

}  // namespace holomorph
