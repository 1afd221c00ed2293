// How far a holomorphic function is from given values: half of the mean square, half of that along
// the boundary and half inside.
#pragma once

#include "core/cauchy/boundary_basis.h"

namespace holomorph {

/// Where a reference is looked at: at or near the boundary's samples, and inside.
struct ReferencePoints {
  Points boundary, inner;
};

class HolomorphicDistance {
 public:
  /// `weight` times the distance; without inner points at the boundary's alone. Cost: a product of
  /// points and unknowns^2.
  HolomorphicDistance(const BoundaryBasis& basis, const ReferencePoints& points, double weight);

  /// P of x'Px / 2 for x = (Re, Im) of whitened unknowns.
  const MatrixXd& quadratic() const { return quadratic_; }
  /// p and c of x'Px / 2 + p'x + c for values at the points. Moduli above `most` say no more than
  /// their direction, values that are not finite nothing.
  struct Target {
    VectorXd linear;
    double constant = 0;
  };
  Target target(const VectorXc& boundary, const VectorXc& inner, double most) const;

  const HolomorphicFit& boundary() const { return boundary_; }
  const MatrixXc& inner() const { return inner_; }  ///< the whitened basis at the inner points

 private:
  double share(const MatrixXc& rows) const;

  HolomorphicFit boundary_;
  MatrixXc inner_;
  double weight_;
  MatrixXd quadratic_;
};

}  // namespace holomorph
