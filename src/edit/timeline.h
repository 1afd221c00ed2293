// The state of the timeline: the current time, playback, and how keyframes are set.
#pragma once

#include <optional>

#include "scene/key_selection.h"

namespace holomorph {

struct Timeline {
  double time = 0;      ///< seconds
  bool active = false;  ///< the canvas shows the picture at `time`, not the scene's own pose
  bool playing = false, loop = true;
  KeySelection keys = {};               ///< the selected keyframes, of any layers
  bool recording = false;               ///< a drag is recorded as keyframes in real time
  bool auto_key = false;                ///< edits of the pose set keyframes
  bool onion = false;                   ///< onion skin: show the keyframes before and after `time`
  bool visible = false;                 ///< the panel is open
  std::optional<double> clock_ms = {};  ///< clock time when `time` last advanced

  /// Goes to a time, clamped to 0 ... kMaxTime, and displays it.
  void go_to(double seconds) {
    time = std::clamp(seconds, 0.0, kMaxTime);
    active = true;
    clock_ms.reset();
  }
};

/// Advances the time with the clock while the timeline plays. After the last keyframe it loops or
/// stops. Returns whether the time advanced.
bool advance(Timeline& timeline, const Scene& scene, double now_ms);

/// The number of the frame nearest to a time.
int frame_at(const Scene& scene, double time);
/// The time of a frame in seconds, clamped to 0 ... kMaxTime.
double time_of_frame(const Scene& scene, int frame);

/// The time of the first keyframe after `time`, or of the last one before it; none if there is no
/// such keyframe.
std::optional<double> next_key(const Deformation& deformation, double time, bool forwards);

}  // namespace holomorph
