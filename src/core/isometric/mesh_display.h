// Evaluates maps without folds at the vertices of a mesh, fast enough for every frame of a drag.
#pragma once

#include "core/bounded/certificate.h"
#include "core/cauchy/cauchy_array.h"
#include "core/mesh/antiderivative.h"

namespace holomorph {

/// The values are accurate to 1e-5 of the displacement where the mesh resolves the map.
class MeshDisplay {
 public:
  /// Precomputes two matrices in single precision, with a row for each vertex and a column for each
  /// polygon vertex. The mesh must outlive this object.
  MeshDisplay(const BoundaryBasis& basis, const Mesh& mesh);

  struct Values {
    VectorXc moved;  ///< f - z, up to a constant; 0 at the tree's root
    Derivatives first;
  };
  /// The map must have Second::nu. Where l = nu = 0 everywhere, `moved` is exactly 0. Cost: one
  /// pass over both matrices.
  Values values(const LogMap& map) const;
  const MeshTree& tree() const { return tree_; }

 private:
  MeshTree tree_;
  PlanarMatrix<float> values_, slopes_;
};

}  // namespace holomorph
