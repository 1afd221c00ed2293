// Snapping: dragged handles stop where they line up with something.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// A guide line to a handle from the point that it lines up with.
struct Guide {
  Complex from, to;
};

/// A handle lines up with anything within `distance` of it along x or y: handles that are not
/// dragged, its own rest position, and the edges and center of the picture.
struct Snapping {
  double distance = 0;  ///< plane units
  std::optional<Box> picture;
};

/// The displacement `by` of a drag, adjusted so that the pressed handle lines up. Appends the guide
/// lines.
Complex snapped(const Deformation& deformation, const Selection& dragged, Handle pressed,
                Complex by, EditMode mode, const Snapping& snapping, std::vector<Guide>& guides);

}  // namespace holomorph
