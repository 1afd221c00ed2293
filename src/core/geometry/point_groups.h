// Divides points into compact groups, so that work can be shared by neighbors.
#pragma once

#include <span>
#include <vector>

#include "core/types.h"

namespace holomorph {

/// Neighboring points, and a disk around them.
struct PointGroup {
  std::vector<Index> indices;  ///< in the list of all points
  Points points;
  Complex center;
  double radius = 0;
};

/// Groups of at most `most` points, and of at least half as many unless there are fewer in all.
/// Cost: n log n.
std::vector<PointGroup> point_groups(std::span<const Complex> points, size_t most);

}  // namespace holomorph
