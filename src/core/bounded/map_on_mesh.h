// Evaluates maps without folds at the vertices of a mesh by integration.
#pragma once

#include "core/bounded/path_integral.h"
#include "core/cauchy/cauchy_array.h"
#include "core/mesh/antiderivative.h"

namespace holomorph {

class MapOnMesh {
 public:
  /// Precomputes two matrices with a row for each vertex and a column for each polygon vertex. Both
  /// arguments must outlive this object.
  MapOnMesh(const BoundaryBasis& basis, const Mesh& mesh);

  /// The map up to a constant, f = Phi + conj(Psi), and its derivatives at the vertices.
  struct Values {
    VectorXc f;
    Derivatives first;
  };
  /// Cost: four products with these matrices.
  Values values(const LogMap& map) const;
  /// Like f in `values`, but accurate to rounding error; see integrated_along.
  VectorXc integrated(const LogMap& map) const { return integrated_along(tree_, basis_, map); }
  /// Phi alone, at the vertices.
  VectorXc phi(const VectorXc& l) const;
  /// Psi at the given locations, one row for each. Column j is the Psi whose derivative has the
  /// coefficients in column j of `coefficients`.
  MatrixXc psi_rows(std::span<const Location> locations, const MatrixXc& coefficients) const;

  const MeshTree& tree() const { return tree_; }

  /// The antiderivative, at the vertices, of a function of the basis. It is 0 in the middle of the
  /// mesh.
  VectorXc antiderivative(const VectorXc& coefficients) const;
  /// The derivative of a function of the basis at the vertices.
  VectorXc slope(const VectorXc& coefficients) const { return product(slopes_, coefficients); }
  /// The values of a function of the basis at the vertices.
  VectorXc function(const VectorXc& coefficients) const { return product(values_, coefficients); }

 private:
  const BoundaryBasis& basis_;
  const Mesh& mesh_;
  MeshTree tree_;
  PlanarMatrix<double> values_, slopes_;  ///< C and C' at the vertices
};

}  // namespace holomorph
