// The energy of an elastic sheet: its resistance to changes of size and shape (membrane), and to
// bending in the plane.
//
// With the membrane alone, a pin pulls out a spike that gets thinner as the mesh gets finer.
// Bending makes single points matter, so that answers do not depend on the mesh.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <memory>

#include "core/mesh/mesh.h"

namespace holomorph {

/// A map in one triangle, where it is linear: f_z and f_zbar.
struct SheetStrain {
  Complex fz, fzbar;
  /// The largest and the smallest stretch; the latter is negative if the triangle is flipped.
  double larger() const { return std::sqrt(std::norm(fz)) + std::sqrt(std::norm(fzbar)); }
  double smaller() const { return std::sqrt(std::norm(fz)) - std::sqrt(std::norm(fzbar)); }
};

/// Derivatives of an energy in x and y of a triangle's three vertices, in turn.
using SheetGradient = Eigen::Matrix<double, 6, 1>;
using SheetHessian = Eigen::Matrix<double, 6, 6>;

/// The energy of a map with values f at a mesh's vertices,
///     E = 1/A sum_t A_t s_t (|J_t|^2 + |J_t^-1|^2) / 2  +  1/A sum_v B_v l_v^2 |H_v|^2 / 2,
/// over triangles t with the Jacobian J_t, area A_t and stiffness s_t, and inner vertices v. A is
/// the sum of A_t s_t. B_v is a third of this sum around v, with equal shares of that of neighbors
/// on the outline. With M_v, a third of the areas around v, the Hessian
///     H_v^ab = -1/M_v sum_{t at v} A_t (d_a phi_v)_t (d_b f)_t,  made symmetric,
/// is recovered from the hat functions phi_v, with natural boundary conditions (mixed elements;
/// Stein and others 2018). Both terms are dimensionless and do not change under rigid motions, nor
/// if all of the sheet gets stiffer. The membrane is 2 for rigid motions, and infinite if a
/// triangle is flipped.
class SheetEnergy {
 public:
  /// `stiffness` has a value for each triangle, and `bending` the length l for each vertex, in
  /// units of the plane. Cost: linear in the number of triangles.
  SheetEnergy(std::shared_ptr<const Mesh> mesh, VectorXd stiffness, const VectorXd& bending);

  const Mesh& mesh() const { return *mesh_; }
  double stiff_area() const { return stiff_area_; }  ///< A
  double membrane(const VectorXc& f) const;
  double bending(const VectorXc& f) const;
  double value(const VectorXc& f) const { return membrane(f) + bending(f); }

  /// The bending energy as f* Q f / 2 with a real, symmetric Q. Vertices that share a neighbor are
  /// coupled.
  const Eigen::SparseMatrix<double>& bending_matrix() const { return bending_; }
  /// Q f, more accurate than as a product: Q has large entries where triangles are small.
  VectorXc bending_gradient(const VectorXc& f) const;
  /// Derivatives of the membrane of one triangle, which must not be flipped. The Hessian is given
  /// by its eigenvectors (isotropic energies; Smith, De Goes, Kim 2019). `projected`: a
  /// negative eigenvalue is replaced by 0.
  SheetGradient gradient_of(size_t triangle, const VectorXc& f) const;
  SheetHessian hessian_of(size_t triangle, const VectorXc& f, bool projected) const;
  SheetStrain strain(size_t triangle, const VectorXc& f) const;
  /// The second derivatives f_xx, f_xy and f_yy at an inner vertex.
  std::array<Complex, 3> hessian_at(int vertex, const VectorXc& f) const;

  /// The first t > 0 at which a triangle of f + t d is flat; infinity if there is none.
  double first_flip(const VectorXc& f, const VectorXc& d) const;

 private:
  /// The z derivatives of the corners' hat functions: f_z is the sum of these times the values of f
  /// at the corners.
  using Gradients = std::array<Complex, 3>;

  struct Changes;
  Changes changes_of(size_t triangle, const SheetStrain& at) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<Gradients> gradients_;
  VectorXd weights_;  ///< A_t s_t / A
  double stiff_area_ = 0;
  Eigen::SparseMatrix<double, Eigen::RowMajor> second_;  ///< f_xx, f_xy and f_yy for each vertex
  VectorXd squares_;  ///< the weights of their squares in twice the bending energy
  Eigen::SparseMatrix<double> bending_;
};

}  // namespace holomorph
