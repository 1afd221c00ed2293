// Edits of the corners whose angles method `angles` sets.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Whether a cage vertex has angles of its own: all do while no corners are listed.
bool is_corner(const Deformation& deformation, Index vertex);
/// A vertex' own angles; none at vertices that are no corners.
PoseCorner corner_at(const Deformation& deformation, Index vertex);

/// By how much its own angles open a corner, in radians: twice what corner_opened turned.
double corner_opening(const Deformation& deformation, Index vertex);

/// With a vertex as a corner more, turned as its edge is there.
Deformation with_corner(Deformation deformation, Index vertex);
/// Without this corner. Throws Error when it is one of three.
Deformation without_corner(Deformation deformation, Index vertex);
Deformation with_all_corners(Deformation deformation);

/// A corner turned by an angle in radians, in a deformation whose method sets angles.
Deformation corner_turned(Deformation deformation, Index vertex, double by);
/// A corner opened: each of its two edges turned away from the other by an angle in radians.
Deformation corner_opened(Deformation deformation, Index vertex, double by);

/// The corner that the edge with this segment of the cage starts at.
Index corner_before(const Deformation& deformation, Index segment);
/// With a tension, 0 to 1, of the edge that starts at a corner.
Deformation with_tension(Deformation deformation, Index corner, double tension);

/// The corners' numbers after a vertex was inserted behind a segment's first, or erased.
void follow_insertion(std::vector<Corner>& corners, Index segment);
void follow_erasure(std::vector<Corner>& corners, Index vertex);

}  // namespace holomorph
