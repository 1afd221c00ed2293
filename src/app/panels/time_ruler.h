// The ruler of the timeline: which seconds it shows, and how it is zoomed and panned.
#pragma once

#include <imgui.h>

#include "edit/workspace.h"

namespace holomorph {

class TimeRuler {
 public:
  /// Places the ruler for this frame, between two positions of the window. Unless it is zoomed, it
  /// shows the whole animation; `holds` keeps what it shows during a drag.
  void place(const Workspace& workspace, float left, float right, bool holds);
  float x(double time) const {
    return left_ + static_cast<float>((time - start_) / length_) * (right_ - left_);
  }
  double time(float x) const {
    return start_ + static_cast<double>((x - left_) / (right_ - left_)) * length_;
  }
  float left() const { return left_; }
  float right() const { return right_; }

  /// Zooms by a factor around a time.
  void zoom(double factor, double around);
  /// Shows the whole animation again.
  void fit() { zoomed_ = false; }
  void pan(double seconds);
  /// Shows more while something is dragged beyond an end. Returns whether it changed.
  bool grow_to(float x);

  /// Draws the ticks with their seconds and frames.
  void draw(ImDrawList& list, const Workspace& workspace, float top, float bottom) const;

 private:
  float left_ = 0, right_ = 1;
  double start_ = 0, length_ = 2;  ///< seconds
  bool zoomed_ = false;
};

}  // namespace holomorph
