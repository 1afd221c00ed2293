// Maps with finitely many unknowns, and their derivatives at elements. All projections onto bounds
// use this interface.
//
// x holds the real unknowns; T x holds (Re f_z, Im f_z, Re f_zbar, Im f_zbar) for each element in
// turn.
#pragma once

#include <memory>

#include "core/bounded/map_on_mesh.h"
#include "core/cauchy/boundary_basis.h"

namespace holomorph {

using Element = Eigen::Vector4d;

class DerivativeOperator {
 public:
  virtual ~DerivativeOperator() = default;
  virtual Index unknowns() const = 0;
  /// The elements' weights, which sum to 1: fractions of the area or of the boundary.
  const VectorXd& weights() const { return weights_; }
  Index elements() const { return weights_.size(); }

  virtual VectorXd apply(const VectorXd& x) const = 0;    ///< T x
  virtual VectorXd adjoint(const VectorXd& y) const = 0;  ///< T^T y
  /// Factors the sum of T_i^T H_i T_i. Solutions of solve() have no component in the null space of
  /// T, such as a translation.
  virtual void factor(const std::vector<Eigen::Matrix4d>& h) = 0;
  virtual VectorXd solve(const VectorXd& right) const = 0;
  /// The map at the mesh's vertices, up to a constant.
  virtual VectorXc map(const VectorXd& x) const = 0;
  /// The unknowns of the map z -> factor z.
  virtual VectorXd similarity(double factor) const = 0;

 protected:
  VectorXd weights_;
};

/// Piecewise linear maps: the unknowns are the vertices' positions, and the elements are the
/// triangles. The mesh must outlive the operator.
std::unique_ptr<DerivativeOperator> mesh_operator(const Mesh& mesh);

/// Harmonic maps with f_z = C a and conj(f_zbar) = C b. The elements are points of the domain.
/// `basis` and `mesh` must outlive the operator.
std::unique_ptr<DerivativeOperator> harmonic_operator(const BoundaryBasis& basis,
                                                      const MapOnMesh& mesh,
                                                      std::span<const Complex> points);

}  // namespace holomorph
