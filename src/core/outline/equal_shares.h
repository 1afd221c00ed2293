// Correspondences of two closed curves by equal shares of their arc lengths.
#pragma once

#include "core/outline/outline_start.h"

namespace holomorph {

/// From the pair of starts that moves the points least: the published start (Segall, Ben-Chen
/// 2016). Cost: 40,000 distances.
Correspondence by_arc_length(const Polyline& source, const Polyline& target);

/// From the pair of starts after which both curves turn most alike: right for strips, however one
/// is bent. Both counter-clockwise. Cost as above.
Correspondence by_turning(const Polyline& source, const Polyline& target);

}  // namespace holomorph
