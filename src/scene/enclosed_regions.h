// Empty regions that a part of a picture encloses, such as the inside of a ring.
#pragma once

#include "scene/cell_grid.h"

namespace holomorph {

/// An empty region (4-neighbors) on a part of a grid.
struct EnclosedRegion {
  int column = 0, row = 0;  ///< of the part's first cell on the whole grid
  Grid<float> depth;        ///< the distance to the content; 0 outside the region
  double deepest = 0;

  /// The closed curve in the region at a distance `level` < deepest from the content, around the
  /// deepest cell, on the whole grid. The deeper cells lie to its left.
  Points curve(double level) const;
};

/// The regions at least one cell of which is `least` or more away from the content, the deepest
/// first. `distance` holds the distances to the content. Regions with a nonzero cell in `taken` are
/// left out. Cost: linear.
std::vector<EnclosedRegion> enclosed_regions(const Grid<float>& distance,
                                             const Grid<std::uint8_t>& taken, double least);

}  // namespace holomorph
