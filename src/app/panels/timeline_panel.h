// The timeline below the canvas: buttons, a time ruler, and the keyframes on it.
#pragma once

#include "app/panels/panels.h"
#include "edit/workspace.h"

namespace holomorph {

class TimelinePanel {
 public:
  void draw(Workspace& workspace, const PanelSizes& sizes);

 private:
  enum class Held { nothing, time, key };
  void draw_rate(Workspace& workspace, float scale);
  void draw_real_rate(const Workspace& workspace);
  void draw_track(Workspace& workspace, float scale);
  void drag(Workspace& workspace, double time, float scale);

  /// A frame that was displayed while playing, and when.
  struct PlayedFrame {
    int frame = 0;
    double at = 0;  ///< seconds
  };
  std::vector<PlayedFrame> played_;
  Held held_ = Held::nothing;   ///< what the pointer drags
  size_t key_ = 0;              ///< index of the dragged keyframe
  std::optional<double> rate_;  ///< frame rate while it is being typed
  double length_ = 2;           ///< length of the ruler in seconds; constant during a drag
};

}  // namespace holomorph
