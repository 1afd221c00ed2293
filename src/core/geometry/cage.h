// The cage: a closed loop of Bezier segments, each with its own degree.
//
// A polygon is a cage whose segments all have degree 1; it has no separate type.
#pragma once

#include <string>

#include "core/error.h"
#include "core/geometry/curve.h"

namespace holomorph {

/// A closed loop of Bezier segments. Segment i stores all of its control points except the last
/// one, which segment i + 1 stores as its first. The number of points that a segment stores is
/// therefore its degree. Value type.
struct Cage {
  std::vector<Points> segments;

  bool operator==(const Cage&) const = default;

  Index size() const { return static_cast<Index>(segments.size()); }
  int degree(Index segment) const { return static_cast<int>(segments[segment].size()); }
  /// Number of control points. A vertex that two segments share counts once.
  Index control_count() const;
  /// The start vertex of segment i, where i is taken modulo size().
  Complex vertex(Index i) const { return segments[(i % size() + size()) % size()][0]; }
  /// All degree(i) + 1 control points of segment i.
  Points controls(Index segment) const;
  /// Position of the first control point of segment i in the list of all control points.
  Index control_offset(Index segment) const;
};

/// An exact point on the boundary of the cage: the parameter t in [0, 1) on segment `segment`.
struct BoundaryPoint {
  Index segment = 0;
  double t = 0.0;
};

/// The position of a boundary point in the plane.
Complex position_of(const Cage& cage, BoundaryPoint point);

/// A cage with straight edges.
Cage polygon_cage(std::span<const Complex> vertices);

/// The end points of the segments. If all degrees are 1, the cage is the polygon with these
/// vertices.
Points vertices_of(const Cage& cage);

/// All control points in file order: segment by segment, with shared vertices once.
VectorXc controls_of(const Cage& cage);

/// `cage` with degrees raised where necessary: no segment has a lower degree than the corresponding
/// segment of `other`. Throws Error if the two have different numbers of segments.
Cage elevated_to(const Cage& cage, const Cage& other);

/// The loop as a polyline. Segments of degree 1 are sampled only at their start, all others at
/// `per_curve` parameters.
Points outline_of(const Cage& cage, int per_curve = 16);

/// The loop as a polygon, accurate to 5e-5 of the cage's diagonal: the vertices of the polygon and
/// their locations on the cage. Straight segments are not divided. Curved segments are divided
/// evenly in the parameter, into at most 1024 pieces.
struct FlatCage {
  Points points;
  std::vector<BoundaryPoint> locations;
};
FlatCage flattened(const Cage& cage);

/// The point on the cage nearest to z. `flat` is the flattened cage. Costs as much as
/// nearest_on_polygon.
BoundaryPoint nearest_on(const Cage& cage, const FlatCage& flat, Complex z);

/// The same loop traversed backward from the same first vertex.
Cage reversed(const Cage& cage);

/// The same loop, traversed counter-clockwise.
Cage counter_clockwise(const Cage& cage);

/// Returns z unless it is a vertex of the counter-clockwise cage. For a vertex, returns an interior
/// point at a distance of 1e-9 times the shorter edge. Derivatives that are infinite at the vertex
/// are evaluated at this point instead.
Complex point_inside_vertex(const Cage& cage, Complex z);

/// For each control point of the cage, its index among the control points of the reversed cage.
std::vector<Index> reversed_columns(const Cage& cage);

/// Splits segment `segment` at parameter t in (0, 1) by de Casteljau's algorithm. The curve does
/// not change.
void insert_vertex(Cage& cage, Index segment, double t);

/// How erase_vertex replaces two curved segments. `curve` fits the old curve by least squares, with
/// the larger of the two degrees. `tangents` uses a cubic with the outer tangents.
enum class Refit { curve, tangents };

/// The parameter of a vertex on the single segment that will replace the two segments at this
/// vertex. With this parameter the speeds on both sides agree, and erase_vertex undoes
/// insert_vertex. Clamped to [0.05, 0.95].
double joint_parameter(const Cage& cage, Index vertex);

/// Removes vertex `vertex`. Two straight segments become one. Curved segments are replaced as
/// `refit` specifies, and `joint` is the parameter of the old vertex on the new curve. The rest
/// cage and the posed cage must use the same `joint`, or the picture slides along the curve. The
/// cage must have more than three segments.
void erase_vertex(Cage& cage, Index vertex, double joint, Refit refit = Refit::curve);

/// Whether every segment is a straight edge traversed at constant speed. Edges of raised degree
/// count as straight.
bool is_straight(const Cage& cage);

/// Whether segment `segment` is a straight edge traversed at constant speed.
bool is_straight(const Cage& cage, Index segment);

/// Throws Error unless the cage can be a rest cage. It must have at least three segments, finite
/// coordinates and a nonzero area. It must not have a segment of zero length, a cusp, a needle
/// below 1e-7 radians or a self-intersection. The message names the segments, and the error's
/// `where` is the position. Needles, self-intersections and the area are tested on the `flattened`
/// cage. Cost for ordinary loops: O(n log n) in the number of flattened points.
void check_rest_cage(const Cage& cage);

/// The error that check_rest_cage would throw, or none if the cage is valid.
std::optional<Error> rest_fault(const Cage& cage);

/// A point as written in messages: "(12, 30.5)".
std::string point_text(Complex z);

}  // namespace holomorph
