// The distance of a holomorphic function from given values: half the mean square difference, with
// equal weights for the boundary and the inside.
#pragma once

#include "core/cauchy/boundary_basis.h"

namespace holomorph {

/// Where a reference is sampled: at or near the boundary's samples, and inside.
struct ReferencePoints {
  Points boundary, inner;
  std::vector<Index> holes = {};  ///< where each hole starts in `boundary`
};

class HolomorphicDistance {
 public:
  /// The distance is multiplied by `weight`. Without inner points it is measured at the boundary
  /// alone. Cost: proportional to points times unknowns^2.
  HolomorphicDistance(const BoundaryBasis& basis, const ReferencePoints& points, double weight);

  /// The matrix P of x'Px / 2, where x = (Re, Im) of the whitened unknowns.
  const MatrixXd& quadratic() const { return quadratic_; }
  /// p and c in x'Px / 2 + p'x + c, for given values at the points. Moduli above `most` are reduced
  /// to `most`; values that are not finite count as 0.
  struct Target {
    VectorXd linear;
    double constant = 0;
  };
  Target target(const VectorXc& boundary, const VectorXc& inner, double most) const;

  const HolomorphicFit& boundary() const { return boundary_; }
  const MatrixXc& inner() const { return inner_; }  ///< the whitened basis at the inner points

 private:
  double row_weight(const MatrixXc& rows) const;

  HolomorphicFit boundary_;
  MatrixXc inner_;
  double weight_;
  MatrixXd quadratic_;
};

}  // namespace holomorph
