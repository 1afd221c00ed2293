// Loops just inside a polygon, and the zeros of a holomorphic function inside a loop.
#pragma once

#include "core/maps/argument.h"

namespace holomorph {

/// A loop at this distance inside a simple, counter-clockwise polygon, with miters at convex
/// corners and where it is straight, and arcs around the other corners. The loop's vertices are at
/// most three times the distance apart. The distance is halved, up to 20 times, until the loop does
/// not cross itself.
Points inner_loop(const Points& polygon, double distance);

/// The number of zeros of a function inside a loop, by the argument principle: its winding number
/// around 0 along the loop. `values` are the function's values at the loop's vertices, and `at`
/// supplies more of them (see argument_changes).
int zeros_inside(const Points& loop, const VectorXc& values, const FunctionValues& at);

}  // namespace holomorph
