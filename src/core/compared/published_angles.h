// Angle maps as Weber, Gotsman 2010 print them, to compare with: generalized Cauchy functions of
// equal parts of the boundary, discontinuous at corners (sec. 4), and the map itself as Cauchy
// coordinates whose derivative comes near to exp(i H) (eq. 7).
#pragma once

#include "core/geometry/cage.h"
#include "core/solvers/dense.h"

namespace holomorph {

class PublishedAngles {
 public:
  /// Of a counter-clockwise cage whose boundary is cut into about `pieces` equal parts (100 in the
  /// paper), with corners among its vertices. The anchor is a place inside. Cost: cubic in the
  /// pieces.
  PublishedAngles(const Cage& cage, const std::vector<Index>& corners, Complex anchor,
                  int pieces = 100);

  /// The map at samples inside for angles theta before and after each corner: f and f', with
  /// f(anchor) = 0 and |f'(anchor)| about 1.
  struct Values {
    VectorXc f, slope;
  };
  Values map(const VectorXd& theta, const Points& samples) const;

  /// The largest error of a boundary angle for one radian at one corner.
  double error() const { return error_; }
  /// The number of functions.
  Index unknowns() const { return coefficients_.rows(); }

 private:
  /// A part of an edge, and the functions that are 1 at its ends.
  struct EdgePart {
    Complex from, to;
    Index start, end;
  };
  MatrixXc functions(std::span<const Complex> points, const std::vector<Index>& parts) const;

  std::vector<EdgePart> parts_;
  Cage nodes_;  ///< the polygon of all parts
  Complex anchor_;
  MatrixXc coefficients_;  ///< of the functions, by angles
  MatrixXc slopes_;        ///< H at the places where f' is fitted, Im H = 0 at the anchor
  MatrixXc fit_;           ///< from f' there to the map's coordinates
  double error_ = 0;
};

}  // namespace holomorph
