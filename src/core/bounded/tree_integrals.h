// Integrals of the derivatives of maps along a tree of paths and along closed paths.
#pragma once

#include "core/bounded/certificate.h"
#include "core/mesh/path_tree.h"

namespace holomorph {

/// There is one integral for each station except the first one, along the path from the first
/// station to it, and one for each closed path.
class TreeIntegrals {
 public:
  TreeIntegrals() = default;
  /// Cost: nodes on the paths times polygon vertices times unknowns.
  TreeIntegrals(const BoundaryBasis& basis, const Mesh& mesh, const Points& stations,
                const std::vector<Points>& loops);

  Index stations() const { return stations_; }
  /// The number of integrals.
  Index count() const { return static_cast<Index>(ends_.size()); }
  /// C and the whitened basis at the nodes, one row per node, and the weights of the nodes.
  const MatrixXc& values() const { return values_; }
  const MatrixXc& whitened() const { return whitened_; }
  const VectorXc& weights() const { return paths_.weights(); }

  /// The sums of values at the nodes along each path.
  VectorXc sums(const VectorXc& at_nodes) const;
  /// The integrals of df, from the weighted values of Phi' and Psi' at the nodes.
  VectorXc of(const VectorXc& phi, const VectorXc& psi) const {
    return sums(phi) + sums(psi).conjugate();
  }

  /// What a change of l and of nu or Psi' does to integrals: combinations of them change by
  /// `wanted`, to first order.
  struct Change {
    MatrixXd combinations;  ///< rows x count()
    VectorXc wanted;        ///< one for each row
    LogMap::Second second = LogMap::Second::nu;
    bool conformal = false;  ///< only l changes
    /// More conditions, on the whitened unknowns x of l and y of w: Re(rows_l x + rows_w y) =
    /// gains.
    MatrixXc rows_l = {}, rows_w = {};
    VectorXd gains = {};
  };
  /// The smallest such change, as coefficients. Sizes are mean squares on the boundary. `at` holds
  /// the weighted values of Phi' and Psi' at the nodes.
  LogMap smallest(const Change& change, const BoundaryBasis& basis, const Derivatives& at) const;

 private:
  PathTree paths_;
  Index stations_ = 0;
  std::vector<Index> ends_;  ///< the last piece of each integral's path
  MatrixXc values_, whitened_;
};

}  // namespace holomorph
