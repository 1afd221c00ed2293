// Removes vertices from a polygon that must keep given points inside.
#pragma once

#include <optional>

#include "core/geometry/cage.h"

namespace holomorph {

/// Whether a simplified polygon may have new vertices.
enum class Simplified { subset, with_corners };

/// Removes vertices from a simple counter-clockwise polygon until `count` remain. Each step makes
/// the smallest possible change of area: it drops a vertex, or replaces two neighbors by the corner
/// where their outer edges meet, unless a subset is wanted. The latter only adds area. The polygon
/// remains simple, and points of `kept` inside it remain inside. Stops early if no vertex can be
/// removed. Cost: about (polygon
/// + kept) per vertex removed.
Points simplified_around(std::span<const Complex> polygon, std::span<const Complex> kept, int count,
                         Simplified kind = Simplified::with_corners);

/// A cage with few vertices around the inside of the given one: at no point does its boundary run
/// farther than `tolerance` from that of the given cage, outside it. Vertices on straight edges
/// vanish, up to rounding. Apart from that, holes stay as they are, and so do cages with curved
/// edges. The result is oriented. Cost: about 10 times vertices^2.
Cage thinned_around(const Cage& cage, double tolerance);

}  // namespace holomorph
