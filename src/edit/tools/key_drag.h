// A drag of keyframes on the timeline: moves, stretches or copies them, as one undo step.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class KeyDrag {
 public:
  enum class Kind { move, copy, stretch_start, stretch_end };

  /// Starts a drag of the selected keyframes at a time of the ruler.
  void start(const Workspace& workspace, Kind kind, double time);
  bool active() const { return active_; }
  /// Moves what is dragged to a time: to whole frames, unless `freely` is set. Where a keyframe
  /// would meet another one, the drag stops.
  void follow(Workspace& workspace, double time, bool freely);
  void end() { active_ = false; }

 private:
  TimeMap map_to(double time) const;

  Kind kind_ = Kind::move;
  bool active_ = false, committed_ = false;
  double start_ = 0;
  Scene scene_;  ///< at the start
  KeySelection keys_;
};

}  // namespace holomorph
