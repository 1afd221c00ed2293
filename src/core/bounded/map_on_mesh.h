// Maps without folds, integrated at a mesh's vertices.
#pragma once

#include "core/bounded/certificate.h"
#include "core/cauchy/cauchy_array.h"
#include "core/mesh/antiderivative.h"

namespace holomorph {

class MapOnMesh {
 public:
  /// Cost: two products of vertices x polygon vertices, precomputed. Both must outlive this.
  MapOnMesh(const BoundaryBasis& basis, const Mesh& mesh);

  /// The map up to a constant, f = Phi + conj(Psi), and its derivatives at the vertices.
  struct Values {
    VectorXc f;
    Derivatives first;
  };
  /// Cost: four products with vertices x polygon vertices.
  Values values(const LogMap& map) const;
  /// The same f to rounding. Cost: 12 rows of the basis for each of the mesh's edges at least.
  VectorXc integrated(const LogMap& map) const;
  /// Phi alone.
  VectorXc phi(const VectorXc& l) const;
  /// Psi at places, one row each, of the functions whose coefficients are the columns.
  MatrixXc psi_rows(std::span<const Location> places, const MatrixXc& coefficients) const;

  /// The antiderivative of a function of the basis, 0 in the middle of the mesh.
  VectorXc antiderivative(const VectorXc& coefficients) const;
  /// A function of the basis at the vertices.
  VectorXc function(const VectorXc& coefficients) const { return product(values_, coefficients); }

 private:
  const BoundaryBasis& basis_;
  const Mesh& mesh_;
  MeshTree tree_;
  PlanarMatrix<double> values_, slopes_;  ///< C and C' at the vertices
};

}  // namespace holomorph
