// Finds the boundary point with which a point coincides, up to rounding.
//
// Half of all points that were rounded onto an edge lie outside it. They get the limits from
// inside, and near a vertex its two segments must agree on the position.
#pragma once

#include <optional>

#include "core/geometry/segment.h"

namespace holomorph {

/// A point on a closed loop of segments.
struct Contact {
  Index segment = 0;
  double s = 0, q = 1;  ///< the parameter t and 1 - t, each to full relative precision
  FinePoint point;      ///< relative to the nearer end of the segment

  bool is_vertex() const { return s == 0; }
};

/// The boundary point nearest to z if its distance is within the rounding of z and of the curves,
/// about 4 eps |z|, or `outside` times that for z outside the loop; else none. Cost: 3 ns per
/// straight segment, plus the roots for each curved segment whose box contains z.
std::optional<Contact> contact_of(std::span<const SegmentPolynomial> loop, Complex z,
                                  double outside = 1);

/// The contact at parameter t in [0, 1) of a segment.
Contact contact_at(std::span<const SegmentPolynomial> loop, Index segment, double t);

/// How far rounding can move a point z that is next to a segment at its parameter s = 1 - q.
double rounding_of(const SegmentPolynomial& segment, Complex z, double s, double q);

}  // namespace holomorph
