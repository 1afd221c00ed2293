// Finds the boundary point with which a point coincides, up to rounding error.
//
// Rounding puts about half of all boundary points outside the loop. These points still get the
// limits from inside. Near a vertex, both adjacent segments must use the same position.
#pragma once

#include <optional>

#include "core/geometry/segment.h"

namespace holomorph {

/// A point on closed loops of segments.
struct Contact {
  Index segment = 0;
  double s = 0, q = 1;  ///< the parameter t and 1 - t, each to full relative precision
  FinePoint point;      ///< relative to the nearer end of the segment

  bool is_vertex() const { return s == 0; }
};

/// Returns the boundary point nearest to z if z is on the boundary up to the rounding error of z
/// and of the curves, which is about 4 eps |z|. For points outside, this tolerance is
/// multiplied by `outside`. Returns nullopt if the boundary is farther away. Cost: 3 ns per
/// straight segment, plus the roots for each curved segment whose box contains z.
std::optional<Contact> contact_of(std::span<const SegmentPolynomial> loops, Complex z,
                                  double outside = 1);

/// The contact at parameter t in [0, 1) of a segment.
Contact contact_at(std::span<const SegmentPolynomial> loops, Index segment, double t);

/// How far rounding can move a point z that is close to a segment, near the parameter s = 1 - q.
double rounding_of(const SegmentPolynomial& segment, Complex z, double s, double q);

}  // namespace holomorph
