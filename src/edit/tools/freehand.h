// A line that the user draws freehand with the button held down. It is smoothed at the end.
#pragma once

#include "edit/input.h"
#include "edit/viewport.h"

namespace holomorph {

class Freehand {
 public:
  void start(const Input& input) {
    line_ = {input.position};
    last_px_ = input.px;
  }
  bool active() const { return !line_.empty(); }
  void cancel() { line_.clear(); }
  /// The line so far, not smoothed.
  const Points& line() const { return line_; }

  /// Follows the pointer. Returns true when the button is released.
  bool follow(const Input& input);
  /// Ends the line and returns it, smoothed and resampled at equal steps of about `step_px`. Empty
  /// if the line is shorter than `shortest_px`. If `closed`, the points form a closed curve.
  Points finish(bool closed, double step_px, double shortest_px, const Viewport& view);

 private:
  Points line_;
  Complex last_px_;
};

}  // namespace holomorph
