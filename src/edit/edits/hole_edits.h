// Edits to the holes of a cage. They change the rest shape, the pose and the keyframes alike.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Adds a hole with one loop of segments at rest. `posed` holds the posed control points, and
/// `in_keyframes` those in each keyframe. If a list is empty, the points are at rest.
Deformation with_hole(Deformation deformation, const Cage& hole, const Points& posed = {},
                      const std::vector<Points>& in_keyframes = {});
/// Removes loop `loop` >= 1 of the cage.
Deformation without_hole(Deformation deformation, Index loop);
/// Removes the holes that have a selected point, or all holes if none has one.
Deformation filled(Deformation deformation, const Selection& selection);

}  // namespace holomorph
