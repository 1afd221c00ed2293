// A holomorphic map f(z) = z + sum C_m(z) d_m at individual points, with its derivative.
//
// The d_m are displacements of the control points of a cage. Unlike the coordinates themselves,
// this sum needs only one polynomial per segment: integral of d(t) / (t - s) dt = d(s) L + a
// polynomial, at each root s.
#pragma once

#include <array>

#include "core/cauchy/cauchy.h"
#include "core/geometry/cage.h"

namespace holomorph {

/// The sum over all segments and its derivative. Both are 0 everywhere if no control point is
/// displaced.
class CauchySum {
 public:
  /// `displacement` has an entry for each control point of `rest`, in file order.
  CauchySum(const Cage& rest, const VectorXc& displacement);

  struct ValueAndSlope {
    Complex f, df;
  };
  /// The sum at a point inside the cage or near its boundary. Outside, the inner branch is
  /// continued across the nearest segment, which lets Newton's method cross the boundary. At a
  /// vertex, the sum is evaluated inside the cage, at a distance of 1e-12 of the shorter edge. If
  /// the derivative has a finite limit at the vertex, the result is this limit. Cost: 40 ns per
  /// straight segment, 0.3 us per curved one.
  ValueAndSlope at(Complex z) const;

 private:
  struct Segment {
    SegmentPolynomial curve;
    Points powers;                   ///< d in powers of v = 2 t - 1
    Points from_start, from_end;     ///< d in powers of t and of 1 - t
    std::array<Points, 3> at_nodes;  ///< d at the nodes of each quadrature rule
    Complex inwards;                 ///< a tiny step from the start into the cage
    double reach = 0;                ///< radius around the start within which poles are omitted
    Index next = 0;                  ///< the segment that starts at the end of this one
    bool is_moved = false;
  };
  static ValueAndSlope integral(const Segment& segment, const Root& root, Complex log,
                                Ends without_poles);

  std::vector<Segment> segments_;
};

}  // namespace holomorph
