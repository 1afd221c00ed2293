// Edits of the corners whose angles method `angles` sets.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// Whether a cage vertex has angles of its own: all do while no corners are listed.
bool is_corner(const Scene& scene, Index vertex);
/// A vertex' own angles; none at vertices that are no corners.
PoseCorner corner_at(const Scene& scene, Index vertex);

/// By how much its own angles open a corner, in radians: twice what corner_opened turned.
double corner_opening(const Scene& scene, Index vertex);

/// With a vertex as a corner more, turned as its edge is there.
Scene with_corner(Scene scene, Index vertex);
/// Without this corner. Throws Error when it is one of three.
Scene without_corner(Scene scene, Index vertex);
Scene with_all_corners(Scene scene);

/// A corner turned by an angle in radians, in a scene whose method sets angles.
Scene corner_turned(Scene scene, Index vertex, double by);
/// A corner opened: each of its two edges turned away from the other by an angle in radians.
Scene corner_opened(Scene scene, Index vertex, double by);

/// The corner that the edge with this segment of the cage starts at.
Index corner_before(const Scene& scene, Index segment);
/// With a tension, 0 to 1, of the edge that starts at a corner.
Scene with_tension(Scene scene, Index corner, double tension);

/// The corners' numbers after a vertex was inserted behind a segment's first, or erased.
void follow_insertion(std::vector<Corner>& corners, Index segment);
void follow_erasure(std::vector<Corner>& corners, Index vertex);

}  // namespace holomorph
