// Correspondences of two closed curves by equal fractions of arc length.
#pragma once

#include "core/outline/outline_start.h"

namespace holomorph {

/// From the pair of starting points that moves the curve's points least. This is the start of the
/// published method (Segall, Ben-Chen 2016). Cost: 40,000 distances.
Correspondence by_arc_length(const Polyline& source, const Polyline& target);

/// From the pair of starting points after which the two curves turn most alike. This is suitable
/// for strips, however one of them is bent. Both curves are counter-clockwise. Cost as above.
Correspondence by_turning(const Polyline& source, const Polyline& target);

}  // namespace holomorph
