// Angle maps as published in Weber, Gotsman 2010, for comparison. H is a sum of generalized Cauchy
// functions on equal parts of the boundary, and is discontinuous at corners (sec. 4). The map is a
// sum of Cauchy coordinates whose derivative approximates exp(i H) (eq. 7).
#pragma once

#include "core/geometry/cage.h"
#include "core/solvers/dense.h"

namespace holomorph {

class PublishedAngles {
 public:
  /// `cage` must be counter-clockwise, and `corners` must be some of its vertices. The boundary is
  /// divided into about `pieces` equal parts (100 in the paper). `anchor` must be inside the cage.
  /// Cost: cubic in the number of pieces.
  PublishedAngles(const Cage& cage, const std::vector<Index>& corners, Complex anchor,
                  int pieces = 100);

  /// f and f' at samples inside the cage, with f(anchor) = 0 and |f'(anchor)| about 1. theta holds
  /// the angles before and after each corner, in radians.
  struct Values {
    VectorXc f, slope;
  };
  Values map(const VectorXd& theta, const Points& samples) const;

  /// The largest error of a boundary angle when one corner's angle is one radian.
  double error() const { return error_; }
  /// The number of functions.
  Index unknowns() const { return coefficients_.rows(); }

 private:
  /// A part of an edge, and the indices of the functions that are 1 at its ends.
  struct EdgePart {
    Complex from, to;
    Index start, end;
  };
  MatrixXc functions(std::span<const Complex> points, const std::vector<Index>& parts) const;

  std::vector<EdgePart> parts_;
  Cage nodes_;  ///< the polygon of all parts
  Complex anchor_;
  MatrixXc coefficients_;  ///< functions x angles
  MatrixXc slopes_;        ///< H where f' is fitted, with Im H = 0 at the anchor
  MatrixXc fit_;           ///< computes the map's coefficients from f' at those points
  double error_ = 0;
};

}  // namespace holomorph
