// Correspondences between two closed curves by equal fractions of arc length.
#pragma once

#include "core/outline/outline_start.h"

namespace holomorph {

/// Uses the pair of starting points for which the source's points move least. This is the start of
/// the published method (Segall, Ben-Chen 2016). Cost: 40,000 distances.
Correspondence by_arc_length(const Polyline& source, const Polyline& target);

/// Uses the pair of starting points for which the two curves turn most similarly. This suits
/// strips, even if one of them is strongly bent. Both curves must be counter-clockwise. Cost:
/// 40,000 subtractions.
Correspondence by_turning(const Polyline& source, const Polyline& target);

}  // namespace holomorph
