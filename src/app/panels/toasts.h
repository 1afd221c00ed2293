// Short messages over the canvas that leave by themselves.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

class Toasts {
 public:
  /// Takes over what the workspace has to say and draws what is still to be read. A message about a
  /// place marks it, and has a button that goes there.
  void draw(Workspace& workspace, const OverlayStyle& style);
  bool empty() const { return shown_.empty(); }
  /// Forgets what has been shown long enough; returns whether anything was.
  bool expire();

 private:
  struct Shown {
    Toast toast;
    double until;
    size_t step;  ///< of the history, when it was said
  };
  std::vector<Shown> shown_;
};

}  // namespace holomorph
