// A drag of a film's bar on the timeline: moves or trims the film, as one undo step.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Changes the clip of the edited layer while the pointer moves.
class ClipDrag {
 public:
  enum class Kind { move, trim_start, trim_end };

  /// Starts a drag of the edited layer's film at a time of the ruler. The layer must have one.
  void start(const Workspace& workspace, Kind kind, double time);
  /// Moves what is dragged to a time. A moved film starts at a frame of the timeline, unless
  /// `freely` is set. A trimmed one keeps at least one frame, and the frames that still play keep
  /// their times.
  void follow(Workspace& workspace, double time, bool freely) const;
  /// Ends the drag; later changes are another undo step.
  void end(Workspace& workspace);

 private:
  Kind kind_ = Kind::move;
  bool active_ = false;
  double from_ = 0;  ///< the time at the start
  Clip clip_;        ///< at the start
};

}  // namespace holomorph
