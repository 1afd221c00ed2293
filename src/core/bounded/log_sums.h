// Sums of maps without folds, and the smallest changes that give their integrals wanted values.
#pragma once

#include "core/bounded/certificate.h"
#include "core/bounded/map_on_mesh.h"
#include "core/bounded/tree_integrals.h"
#include "core/mesh/hole_loops.h"

namespace holomorph {

/// The functions l and nu of weighted maps, added up, and a change of the sum in the space L_nu.
struct LogSum {
  std::vector<std::pair<double, const LogMap*>> terms;
  LogMap change;

  /// Whether the sum is in L_nu, because all terms are.
  bool is_nu() const;
  /// The sum as a single map, if it is in L_nu.
  LogMap single() const;
  /// Phi' and Psi' at points, from the values C of the basis there.
  Derivatives at(const MatrixXc& c) const;
};

/// Sums of maps of one basis. Threads: const functions may run at the same time.
class LogSums {
 public:
  /// Integrals go from the first station to each of the others, and around each hole.
  LogSums(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
          const Points& stations);

  /// A sum without a change.
  LogSum of(std::vector<std::pair<double, const LogMap*>> terms) const;
  /// The root mean square of l and nu on the boundary, for a sum in L_nu.
  double norm(const LogSum& sum) const;
  /// Tries to prove, with a tolerance of 1 %, that the shear and the smallest size of the sum stay
  /// within the given extremes, and that its largest size exceeds them by at most the fraction
  /// `growth`. If a term is in L_psi, its nu is not in the basis: by convexity, the terms alone
  /// stay within their own extremes, which `within` must cover, and only the change has to be
  /// small.
  bool certify(const LogSum& sum, const Extremes& within, double growth) const;

  /// The integrals of df: one for each station except the first one, and one for each hole.
  VectorXc integrals(const LogSum& sum) const;
  Index holes() const { return static_cast<Index>(loops_.paths().size()); }
  Index count() const { return integrals_.count(); }  ///< of integrals
  /// The map up to a constant, and its derivatives, at the mesh's vertices.
  MapOnMesh::Values on_mesh(const LogSum& sum) const;
  /// f, integrated along the mesh, minus the jumps that it has if integrals around holes are
  /// `gaps`. These are spread over the picture.
  VectorXc without_jumps(VectorXc f, const VectorXc& gaps) const;

  /// Combinations of integrals, and what they should be.
  struct Constraints {
    MatrixXd combinations;  ///< rows x integrals
    VectorXc targets;       ///< one for each row
  };
  /// What combinations of integrals miss their targets by.
  VectorXc misses(const Constraints& kept, const LogSum& sum) const {
    return kept.targets - kept.combinations * integrals(sum);
  }
  /// The smallest change that meets the targets, by Gauss-Newton steps from the change that the sum
  /// has. `conformal`: only l changes.
  LogMap change(const Constraints& kept, LogSum sum, bool conformal) const;
  /// Like change(), but also keeps |nu| and the size within bounds at the samples of the boundary.
  /// Where a sample is outside a bound, its value is prescribed from then on: |nu|, or the
  /// logarithm Re l + ln(1 - |nu|) of the size.
  LogMap bounded_change(const Constraints& kept, LogSum sum, const Extremes& bounds,
                        bool conformal) const;

  const BoundaryBasis& basis() const { return *basis_; }
  const Mesh& mesh() const { return *mesh_; }
  const Certifier& certifier() const { return certifier_; }
  const MapOnMesh& evaluated() const { return on_mesh_; }
  double size() const { return size_; }  ///< the diagonal of the mesh's box

 private:
  Derivatives weighted(const LogSum& sum) const;

  std::shared_ptr<const BoundaryBasis> basis_;
  std::shared_ptr<const Mesh> mesh_;
  Certifier certifier_;
  MapOnMesh on_mesh_;
  HoleLoops loops_;
  TreeIntegrals integrals_;
  double size_;
};

}  // namespace holomorph
