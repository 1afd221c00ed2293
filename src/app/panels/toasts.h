// Short messages over the canvas that disappear by themselves.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

class Toasts {
 public:
  /// Takes the messages of the workspace and draws those that have not expired. A message about a
  /// point marks it and has a button that goes there.
  void draw(Workspace& workspace, const OverlayStyle& style);
  bool empty() const { return shown_.empty(); }
  /// Removes messages that have been shown long enough. Returns whether there were any.
  bool expire();

 private:
  struct Shown {
    Toast toast;
    double until;
    size_t step;  ///< of the history, when the message came
  };
  std::vector<Shown> shown_;
};

}  // namespace holomorph
