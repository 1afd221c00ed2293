// Moves a map so that a frame stays where it is.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <memory>
#include <vector>

#include "core/mesh/mesh.h"

namespace holomorph {

/// Some coordinates of a mesh's vertices, which stay at rest. Immutable.
class FixedCoordinates {
 public:
  /// `fixed` has marks for x and y of each vertex; empty: none stay. Cost: two sparse
  /// factorizations.
  FixedCoordinates(std::shared_ptr<const Mesh> mesh, const std::vector<std::array<bool, 2>>& fixed);

  /// Puts the fixed coordinates of a map, which has a value for each vertex, back to rest. The
  /// others follow by the displacement of least Dirichlet energy. Triangles may flip. Cost: two
  /// sparse solves.
  void restore(VectorXc& f) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  struct Axis {
    std::vector<int> fixed, free;
    Matrix coupling;  ///< of free with fixed coordinates
    Eigen::SimplicialLDLT<Matrix> factor;
  };

  std::shared_ptr<const Mesh> mesh_;
  std::array<Axis, 2> axes_;
};

}  // namespace holomorph
