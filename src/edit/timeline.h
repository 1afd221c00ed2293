// The keyframes as they are being watched and set: a time, and whether it moves.
#pragma once

#include <optional>

#include "scene/keyframes.h"

namespace holomorph {

struct Timeline {
  double time = 0;      ///< seconds
  bool active = false;  ///< the picture is that of the time, not the scene's own pose
  bool playing = false, loop = true;
  bool chosen = false;                  ///< the key at the time was clicked
  bool recording = false;               ///< a drag sets keys, by the clock
  bool auto_key = false;                ///< pose edits set keys
  bool onion = false;                   ///< the pictures of the keys beside the time
  bool visible = false;                 ///< the panel
  std::optional<double> clock_ms = {};  ///< when the time was advanced last

  /// Shows a time, at least 0.
  void go_to(double seconds) {
    time = std::clamp(seconds, 0.0, kMaxTime);
    active = true;
    chosen = false;
    clock_ms.reset();
  }
};

/// Lets a playing time go on by the clock; behind the last key it starts again or stops. Returns
/// whether it moved.
bool advance(Timeline& timeline, const Scene& scene, double now_ms);

/// The frame that is nearest to a time, and its time.
int frame_at(const Scene& scene, double time);
double time_of_frame(const Scene& scene, int frame);

/// The next key's time behind a time (or before it); none behind the last one.
std::optional<double> next_key(const Deformation& deformation, double time, bool forwards);

}  // namespace holomorph
