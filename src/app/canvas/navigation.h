// Pans and zooms the canvas with the pointer.
#pragma once

#include "edit/tools/tool.h"

namespace holomorph {

/// Dragging with the middle button, or with Space held, pans. The wheel zooms. Space that is
/// pressed and released without a drag is a tap, which plays the animation.
class Navigation {
 public:
  struct Outcome {
    bool moved = false;   ///< the view was panned or zoomed
    bool tapped = false;  ///< Space was tapped
  };

  /// Call this once per frame. `space` is whether Space is held, and `for_canvas` is whether the
  /// canvas has the keyboard focus. Withholds input from the tools while the view pans or Space is
  /// held.
  Outcome navigate(Input& input, bool space, bool for_canvas, Viewport& viewport);

 private:
  bool panning_ = false, space_ = false;
  bool space_used_ = false;  ///< Space was used for something else, so releasing it is not a tap
};

}  // namespace holomorph
