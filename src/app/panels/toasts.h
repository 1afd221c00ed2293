// Short messages over the canvas that disappear by themselves.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

class Toasts {
 public:
  /// Takes over the workspace's messages, and draws all messages that have not expired. For a
  /// message about a point, marks the point and draws a button that moves the view there.
  void draw(Workspace& workspace, const OverlayStyle& style, double now_ms);
  bool empty() const { return shown_.empty(); }
  /// Removes expired messages. Returns whether it removed any.
  bool expire(double now_ms);

 private:
  struct Shown {
    Toast toast;
    double until;
    size_t step;  ///< index of the history's current step when the message arrived
  };
  std::vector<Shown> shown_;
};

}  // namespace holomorph
