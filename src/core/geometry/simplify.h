// Removes vertices from a polygon that must keep given points inside.
#pragma once

#include "core/geometry/curve.h"

namespace holomorph {

/// Removes vertices from a simple counter-clockwise polygon until `count` remain. Each step makes
/// the smallest possible change of area: it drops a vertex, or replaces two neighbors by the corner
/// where their outer edges meet. The latter only adds area. The polygon remains simple, and points
/// of `kept` inside it remain inside. Stops early if no vertex can be removed. Cost: about (polygon
/// + kept) per vertex removed.
Points simplified_around(std::span<const Complex> polygon, std::span<const Complex> kept,
                         int count);

}  // namespace holomorph
