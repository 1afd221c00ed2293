// The line on the canvas between the picture before (left) and after (right) the deformation.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

class SplitLine {
 public:
  /// Lets the user drag the line. Input near the line is withheld from everything else.
  void drag(Input& input, DisplayOptions& display);

 private:
  bool dragging_ = false;
};

/// Whether a position is in the "before" part, where nothing can be grabbed.
bool is_before(const DisplayOptions& display, Complex px);

/// Draws the line, if there is one.
void draw_split_line(const DisplayOptions& display, const OverlayStyle& style);

}  // namespace holomorph
