// The timeline under the canvas: buttons, a ruler of times, and the keys on it.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class TimelinePanel {
 public:
  void draw(Workspace& workspace, double scale);

 private:
  enum class Held { nothing, time, key };
  void draw_rate(Workspace& workspace, float scale);
  void draw_track(Workspace& workspace, float scale);
  void drag(Workspace& workspace, double time, float scale);

  Held held_ = Held::nothing;   ///< by the pointer
  size_t key_ = 0;              ///< the one that is held
  std::optional<double> rate_;  ///< while it is being typed
  double length_ = 2;           ///< of the ruler in seconds, which stays while something is held
};

}  // namespace holomorph
