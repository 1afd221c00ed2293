// Dragged handles stop where they line up with something.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// A line that a handle was stopped at, from what it lines up with to where the handle is.
struct Guide {
  Complex from, to;
};

/// Where handles may line up, with what lies within `distance` along x or y: handles that are not
/// dragged, the handle's own place at rest, and the picture's edges and middle.
struct Snapping {
  double distance = 0;
  std::optional<Box> picture;
};

/// A drag of handles, changed so that the pressed one lines up; appends what it lines up with.
Complex snapped(const Deformation& deformation, const Selection& dragged, Handle pressed,
                Complex by, EditMode mode, const Snapping& snapping, std::vector<Guide>& guides);

}  // namespace holomorph
