// The cage: a closed loop of Bezier segments, each with a degree of its own.
//
// A polygon is a cage of degree 1 everywhere; there is no second cage type.
#pragma once

#include <string>

#include "core/error.h"
#include "core/geometry/curve.h"

namespace holomorph {

/// A closed loop of Bezier segments. Segment i holds its control points without the last one, which
/// is the first of segment i + 1, so its degree is its length. Value type.
struct Cage {
  std::vector<Points> segments;

  bool operator==(const Cage&) const = default;

  Index size() const { return static_cast<Index>(segments.size()); }
  int degree(Index segment) const { return static_cast<int>(segments[segment].size()); }
  /// Number of control points, a vertex that two segments share counted once.
  Index control_count() const;
  /// The vertex that segment i starts at; i is taken modulo size().
  Complex vertex(Index i) const { return segments[(i % size() + size()) % size()][0]; }
  /// All degree(i) + 1 control points of segment i.
  Points controls(Index segment) const;
  /// Position of the first control point of segment i in the list of all control points.
  Index control_offset(Index segment) const;
};

/// A point of the cage's boundary, addressed exactly: parameter t in [0, 1) on segment `segment`.
struct BoundaryPoint {
  Index segment = 0;
  double t = 0.0;
};

/// The place of a boundary point in the plane.
Complex position_of(const Cage& cage, BoundaryPoint point);

/// A cage with straight edges.
Cage polygon_cage(std::span<const Complex> vertices);

/// The segments' end points: the polygon that a cage of degree 1 is.
Points vertices_of(const Cage& cage);

/// All control points in file order: segment by segment, shared vertices once.
VectorXc controls_of(const Cage& cage);

/// `cage` with each segment's degree raised to at least that of the same segment of `other`.
/// Throws Error when the two have different numbers of segments.
Cage elevated_to(const Cage& cage, const Cage& other);

/// The loop as a polyline: each segment sampled at `per_curve` parameters when curved, at its start
/// alone when straight.
Points outline_of(const Cage& cage, int per_curve = 16);

/// The loop as a polygon within 5e-5 of its size: its vertices and where on the cage they are.
/// Straight segments stay whole; curved ones are cut evenly in the parameter, into at most 1024.
struct FlatCage {
  Points points;
  std::vector<BoundaryPoint> places;
};
FlatCage flattened(const Cage& cage);

/// The cage's point nearest to z; `flat` is the flattened cage. Cost: that of nearest_on_polygon.
BoundaryPoint nearest_on(const Cage& cage, const FlatCage& flat, Complex z);

/// The same loop run through backwards, from the same first vertex.
Cage reversed(const Cage& cage);

/// The same loop run through counter-clockwise.
Cage counter_clockwise(const Cage& cage);

/// z itself but, at a vertex of a counter-clockwise cage, a point inside that is 1e-9 of the
/// shorter edge away: where derivatives that are infinite at vertices are looked at.
Complex beside_vertex(const Cage& cage, Complex z);

/// For each control point of the cage its number among those of the reversed cage.
std::vector<Index> reversed_columns(const Cage& cage);

/// Cuts segment `segment` at parameter t in (0, 1) by de Casteljau: the curve stays as it is.
void insert_vertex(Cage& cage, Index segment, double t);

/// What happens to curved neighbors of a vertex that is removed: they follow the old curve by
/// least squares with the larger degree, or become one cubic with the outer tangents.
enum class Refit { curve, tangents };

/// The parameter that a vertex has on the one segment which its two become: the speeds there agree,
/// so that a cut made by insert_vertex heals. Clamped to [0.05, 0.95].
double joint_parameter(const Cage& cage, Index vertex);

/// Removes vertex `vertex`. Two straight segments become one; `refit` says what curved ones do,
/// with `joint` the vertex's parameter on the new curve: rest and pose must use the same one, or
/// the picture slides along them. The cage must have more than three segments.
void erase_vertex(Cage& cage, Index vertex, double joint, Refit refit = Refit::curve);

/// Whether every segment runs along its chord at constant speed (degree-raised edges do).
bool is_straight(const Cage& cage);

/// Whether segment i is a straight edge, run through at constant speed.
bool is_straight(const Cage& cage, Index segment);

/// Throws Error unless the cage can be a rest cage: at least three segments, finite, no segment of
/// zero length, no cusp, an area, no needle below 1e-7 radians, and no crossing with itself. The
/// message names the segments and the error's `where` is the place. Curves are judged as
/// `flattened`. Cost: O(n log n) in its points for ordinary loops.
void check_rest_cage(const Cage& cage);

/// What check_rest_cage would throw; none when the cage can rest.
std::optional<Error> rest_fault(const Cage& cage);

/// "(12, 30.5)": how messages write a point.
std::string point_text(Complex z);

}  // namespace holomorph
