// The timeline below the canvas: playback, the current time, and the keyframes of all layers.
#pragma once

#include "app/panels/panels.h"
#include "app/panels/timeline_rows.h"
#include "edit/workspace.h"

namespace holomorph {

class TimelinePanel {
 public:
  /// The height that the panel needs, in px.
  double height(const Workspace& workspace, const PanelSizes& sizes) const;
  void forget() { rows_.forget(); }
  bool take_growth() { return rows_.take_growth(); }
  /// The status bar's text while the pointer is on the ruler or on the rows; else empty.
  std::string hint() const;
  void draw(Workspace& workspace, Thumbnails& thumbnails, const PanelSizes& sizes);

 private:
  void draw_numbers(Workspace& workspace, bool with_length);
  void draw_zoom(Workspace& workspace, float right, bool with_zoom);
  void draw_real_rate(const Workspace& workspace, float end);

  /// A frame that was displayed while playing, and when.
  struct PlayedFrame {
    int frame = 0;
    double at = 0;  ///< seconds
  };
  std::vector<PlayedFrame> played_;
  std::optional<double> frame_;  ///< while its field is dragged
  TimelineRows rows_;
};

}  // namespace holomorph
