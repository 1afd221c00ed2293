// A line drawn in one go with the button down, its tremor smoothed.
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
  /// So far.
  const Points& line() const { return line_; }

  /// Follows the pointer; true when the button was let go.
  bool follow(const Input& input);
  /// Ends it: the smoothed line at equal steps of about `step_px`, run together with its start when
  /// it closes; empty when it is shorter than `shortest_px`.
  Points finish(bool closed, double step_px, double shortest_px, const Viewport& view);

 private:
  Points line_;
  Complex last_px_;
};

}  // namespace holomorph
