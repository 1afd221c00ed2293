// Loops just inside of a polygon, and zeros of a holomorphic function inside of them.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// A polygon at this distance inside a simple, counter-clockwise one, its vertices at most three
/// distances apart: mitres at convex corners, arcs around the others. Nearer, down to a 256th of
/// the distance, where the loop would cross itself.
Points inner_loop(const Points& polygon, double distance);

/// How often a function turns around 0 along a loop, by its values at the loop's vertices, and by
/// more of them between neighbors that turn by more than half a radian: the zeros inside (argument
/// principle). Cost: mostly `at`, called up to twenty times.
int zeros_inside(const Points& loop, const VectorXc& values,
                 const std::function<VectorXc(const Points&)>& at);

}  // namespace holomorph
