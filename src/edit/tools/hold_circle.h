// The circle beyond which the picture is held, and its drag.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

struct Input;

/// Follows the pointer over the circles around the pins (Deformation::held_beyond).
class HoldCircle {
 public:
  void hover(const Input& input, const Workspace& workspace);
  bool hovered() const { return pin_.has_value(); }
  bool active() const { return active_; }

  /// Starts a drag on the hovered circle.
  void start(const Input& input, const Workspace& workspace);
  void follow(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  std::optional<size_t> pin_;  ///< the pin whose circle is under the pointer
  bool active_ = false;
  double start_distance_ = 0;  ///< of the pointer from the pin at rest, in the plane
  Deformation start_deformation_;
};

}  // namespace holomorph
