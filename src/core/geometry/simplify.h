// Fewer vertices for a polygon that has to keep points inside.
#pragma once

#include "core/geometry/curve.h"

namespace holomorph {

/// Takes vertices away from a simple counter-clockwise polygon until `count` remain, cheapest
/// change of area first, so that it stays simple and never gives up a point of `kept` that it
/// contains. A vertex is dropped, or two neighbors are replaced by the corner where the edges
/// beside them meet, which only adds area. Stops early, with more vertices, when nothing can be
/// taken away. Cost: about (polygon + kept) per vertex removed.
Points simplified_around(std::span<const Complex> polygon, std::span<const Complex> kept,
                         int count);

}  // namespace holomorph
