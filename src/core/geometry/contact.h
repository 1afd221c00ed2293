// Which point of a boundary a point is, as well as rounding can tell.
//
// Half of all points that were rounded onto an edge lie outside of it. They take the limits from
// inside, and near a vertex both of its segments must agree on where that is.
#pragma once

#include <optional>

#include "core/geometry/segment.h"

namespace holomorph {

/// A point of a closed loop of segments.
struct Contact {
  Index segment = 0;
  double s = 0, q = 1;  ///< its parameter t and 1 - t, each to its own relative precision
  FinePoint point;      ///< relative to the nearer end of the segment

  bool is_vertex() const { return s == 0; }
};

/// The boundary's nearest point to z when their distance is within the rounding of z and of the
/// curves, about 4 eps |z|, outside `outside` times that; else none. Cost: 3 ns a straight segment,
/// and the roots of curved segments whose box z is in.
std::optional<Contact> contact_of(std::span<const SegmentPolynomial> loop, Complex z,
                                  double outside = 1);

/// The contact at parameter t in [0, 1) of a segment.
Contact contact_at(std::span<const SegmentPolynomial> loop, Index segment, double t);

/// By how much rounding can move a point z next to a segment, at the segment's parameter s = 1 - q.
double rounding_of(const SegmentPolynomial& segment, Complex z, double s, double q);

}  // namespace holomorph
