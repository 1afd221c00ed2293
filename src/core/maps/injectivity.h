// What can be seen of a map on a mesh: whether, and where, the picture lies over itself.
#pragma once

#include <optional>

#include "core/mesh/mesh.h"

namespace holomorph {

struct Injectivity {
  /// How often the boundary's image turns, drawn to 3e-4 of its size: 1, and 1 more for each zero
  /// of f' of a conformal map, around which the picture folds; -1 for a picture on its back.
  /// Smaller loops, as corners of outlines leave them, cannot be seen.
  double turning_number = 1;
  /// Where the picture is turned over, posed: a place for each part, the largest part first; none
  /// when all of them are less than 1e-4 of its area. If nothing is turned over and the boundary
  /// still turns more than once, where most is pressed to nothing: near a zero of f'.
  Points folds_at;
  /// The least |f_z| - |f_zbar| of the triangles, but for a thousandth of the picture: the factor
  /// of the most shrunken direction; below 0 where it is turned over.
  double least_stretch = 1;
  /// Where the boundary's image crosses itself: parts may lie over each other without a fold.
  std::optional<Complex> crossing;

  bool folds() const { return !folds_at.empty() || std::abs(turning_number - 1) > 0.01; }
};

/// Of the map that takes the mesh's vertices to f. Cost: linear, and n log n in the boundary.
Injectivity injectivity_of(const Mesh& mesh, const VectorXc& f);

}  // namespace holomorph
