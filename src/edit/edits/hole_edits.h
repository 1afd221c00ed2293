// Edits to the holes and parts of a cage. They change the rest shape, the pose and the keyframes
// alike.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Adds a hole with one loop of segments at rest. `posed` holds the posed control points, and
/// `in_keyframes` those in each keyframe. If a list is empty, the points are at rest.
Deformation with_hole(Deformation deformation, const Cage& hole, const Points& posed = {},
                      const std::vector<Points>& in_keyframes = {});
/// Removes loop `loop` of the cage, which is a hole.
Deformation without_hole(Deformation deformation, Index loop);
/// Removes one of several parts of the cage, with its holes.
Deformation without_part(Deformation deformation, Index part);
/// Removes the holes that have a selected point, or all holes if none has one.
Deformation filled(Deformation deformation, const Selection& selection);

}  // namespace holomorph
