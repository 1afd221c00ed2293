// Removes vertices from a polygon that must keep given points inside.
#pragma once

#include "core/geometry/curve.h"

namespace holomorph {

/// Removes vertices from a simple counter-clockwise polygon until `count` remain, the smallest
/// change of area first. The polygon stays simple and keeps all points of `kept` that it contains.
/// Each step drops a vertex, or replaces two neighbors by the corner where their outer edges meet,
/// which only adds area. Stops early, with more vertices, if no vertex can be removed. Cost: about
/// (polygon + kept) per vertex removed.
Points simplified_around(std::span<const Complex> polygon, std::span<const Complex> kept,
                         int count);

}  // namespace holomorph
