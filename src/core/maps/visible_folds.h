// The folds of a map that can be seen: regions of flipped triangles that are large enough, and
// points around which the picture winds more than once.
#pragma once

#include "core/maps/injectivity.h"

namespace holomorph {

/// A visible fold: a region of flipped triangles, or the surroundings of a branch point.
struct Fold {
  Complex at;                       ///< posed
  double radius = 0;                ///< of the region, posed, in plane units
  std::vector<int> triangles = {};  ///< those that are flipped and visible
};

/// The visible folds of the map that takes the mesh's vertices to f, the largest first. A region
/// counts if its visible triangles cover more than a pixel of the export at scale 1. `visible` has
/// a mark for each triangle; without marks, all are visible. `found` is injectivity_of the map.
/// Cost: linear.
std::vector<Fold> visible_folds(const Mesh& mesh, const VectorXc& f, const Injectivity& found,
                                const std::vector<char>& visible = {});

}  // namespace holomorph
