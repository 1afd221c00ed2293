// Dragging a whole layer with the pointer.
#pragma once

#include "edit/input.h"
#include "edit/workspace.h"

namespace holomorph {

/// The deformation with its pose and all its keyframes moved. The rest shape stays.
Deformation moved_as_whole(Deformation deformation, Complex by);
/// A cage around the whole picture, for moving, scaling and rotating it.
Deformation with_box(Deformation deformation, const Image& picture);

/// The topmost layer that shows a visible pixel at a position of the canvas, in window px; none if
/// there is none. Hidden layers do not count.
std::optional<size_t> layer_at(const Workspace& workspace, Complex px);
/// Whether a layer shows a visible pixel at a position of the canvas, in window px.
bool shows_at(const Workspace& workspace, size_t layer, Complex px);

/// Makes the layer under the pointer the edited one if the edited layer is locked or hidden, so
/// that it cannot be edited itself.
void leave_closed_layer(Workspace& workspace, Complex px);

class LayerDrag {
 public:
  /// Makes the layer under the pointer the edited one, and starts to drag it. Returns false if
  /// there is no layer, or if it is locked or cannot be moved.
  bool start(const Input& input, Workspace& workspace);
  bool active() const { return active_; }
  bool moving() const { return moving_; }
  /// Follows the pointer, and commits one step on release.
  void follow(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  Complex start_px_, start_;
  Deformation shown_, own_;  ///< at the start, with a cage
  bool active_ = false, moving_ = false;
};

}  // namespace holomorph
