// Encloses an outline of many edges in a loop of a few curves.
#pragma once

#include "core/geometry/cage.h"

namespace holomorph {

/// A closed loop of about `wanted` cubic segments along the closed polyline `outline`, which must
/// be counter-clockwise and simple. The loop strictly encloses `kept`, a polyline inside the
/// outline. Where a segment would cut `kept`, more segments are added. Joints are smooth except at
/// real corners. If no loop of curves is found, returns the polygon of simplified_around instead.
/// Cost: 20 ms for 3000 points and 30 segments.
Cage curves_around(const Points& outline, const Points& kept, int wanted);

}  // namespace holomorph
