// Closed paths around the holes of a mesh.
//
// A function with a given derivative is single-valued if the integral of the derivative along each
// of these paths is 0. Otherwise, the function must jump by the value of that integral somewhere.
#pragma once

#include "core/mesh/antiderivative.h"

namespace holomorph {

class HoleLoops {
 public:
  /// The paths stay as far from `polygon` as possible, relative to their length. The polygon must
  /// surround the mesh and have a loop in each of its holes. Cost: mesh edges times polygon
  /// vertices; nothing without holes.
  HoleLoops(const Mesh& mesh, PolygonView polygon);

  /// One path for each hole. Together, they generate all closed paths. The first point follows the
  /// last one.
  const std::vector<Points>& paths() const { return paths_; }

  /// The smooth function of the vertices to subtract from a function that was integrated along the
  /// edges of a tree, if its integrals along the paths are `jumps`. The difference does not jump.
  VectorXc correction(const MeshTree& tree, const VectorXc& jumps) const;

 private:
  std::vector<Points> paths_;
  Points centers_;     ///< a point in each hole
  MatrixXd windings_;  ///< of each path around each center
};

}  // namespace holomorph
