// Visible folds and overlaps of a map on a mesh: whether there are any, and where.
#pragma once

#include <optional>

#include "core/mesh/mesh.h"

namespace holomorph {

struct Injectivity {
  /// turning_number of the boundary's image after simplification to 3e-4 of its size. It is 1
  /// without folds and -1 for a mirrored picture. For a conformal map, each zero of f' adds 1, and
  /// the picture folds around it. Loops below this size, such as those at corners of outlines, are
  /// invisible and do not count. Always 1 if no triangle is flipped and the triangles around each
  /// inner vertex close after one turn.
  double turning_number = 1;
  /// One posed position in each flipped region, the largest region first. Regions that together
  /// cover less than 1e-4 of the picture's area are ignored. The list is then empty if the turning
  /// number is 1. Otherwise, it holds the position where the picture is compressed most, which is
  /// near a zero of f'.
  Points folds_at;
  /// The smallest |f_z| - |f_zbar| of the triangles, ignoring the worst thousandth of the picture.
  /// This is the scale factor in the most compressed direction. It is negative if a visible part of
  /// the picture is flipped.
  double least_stretch = 1;
  /// A point where the boundary's image crosses itself. The picture may then overlap itself without
  /// a fold.
  std::optional<Complex> crossing;

  bool folds() const { return !folds_at.empty() || std::abs(turning_number - 1) > 0.01; }
};

/// Analyzes the map that takes the mesh's vertices to f. Cost: linear, plus n log n in the
/// boundary.
Injectivity injectivity_of(const Mesh& mesh, const VectorXc& f);

}  // namespace holomorph
