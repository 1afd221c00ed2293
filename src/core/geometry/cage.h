// The cage: closed loops of Bezier segments, each with its own degree. The first loop is the
// outline of a domain. Others are its holes, or the outlines of further parts with their holes.
//
// A polygon can be a cage whose segments all have degree 1.
#pragma once

#include <string>

#include "core/error.h"
#include "core/geometry/curve.h"
#include "core/geometry/polygon.h"

namespace holomorph {

/// Closed loops of Bezier segments. Segment i stores all of its control points except the last one,
/// which the next segment of its loop stores as its first. The number of points that a segment
/// stores is therefore its degree. Value type.
struct Cage {
  std::vector<Points> segments;    ///< of an outline, and then of its holes, for each part
  std::vector<Index> starts = {};  ///< the first segment of each loop after the first one
  std::vector<Index> parts = {};   ///< those of `starts` that begin the outline of a further part

  bool operator==(const Cage&) const = default;

  Index size() const { return static_cast<Index>(segments.size()); }
  Loops loops() const { return {size(), starts}; }
  bool has_holes() const { return starts.size() > parts.size(); }
  Index part_count() const { return static_cast<Index>(parts.size()) + 1; }
  bool is_hole(Index loop) const {
    return loop > 0 && !std::ranges::binary_search(parts, loops().first(loop));
  }
  /// The next and the previous segment in the same loop. Also the next and previous vertex.
  Index next(Index segment) const { return loops().next(segment); }
  Index before(Index segment) const { return loops().before(segment); }
  int degree(Index segment) const { return static_cast<int>(segments[segment].size()); }
  /// Number of control points. A vertex that two segments share counts once.
  Index control_count() const;
  /// The vertex at the start and at the end of segment i.
  Complex vertex(Index i) const { return segments[i][0]; }
  Complex end_vertex(Index i) const { return vertex(next(i)); }
  /// All degree(i) + 1 control points of segment i.
  Points controls(Index segment) const;
  /// Position of the first control point of segment i in the list of all control points.
  Index control_offset(Index segment) const;
  /// Position of control point m, from 0 to degree(i), of segment i.
  Index control_index(Index segment, int m) const {
    return control_offset(m < degree(segment) ? segment : next(segment)) +
           (m < degree(segment) ? m : 0);
  }
};

/// An exact point on the boundary of the cage: the parameter t in [0, 1) on segment `segment`.
struct BoundaryPoint {
  Index segment = 0;
  double t = 0.0;
};

/// The position of a boundary point in the plane.
Complex position_of(const Cage& cage, BoundaryPoint point);

/// A cage with straight edges.
Cage polygon_cage(PolygonView polygon);

/// The end points of the segments. If all degrees are 1, the cage is the polygon with these
/// vertices.
Points vertices_of(const Cage& cage);

/// All control points in file order: segment by segment, with shared vertices once.
VectorXc controls_of(const Cage& cage);

/// Throws Error unless both cages have the same numbers of segments, in every loop.
void check_same_loops(const Cage& rest, const Cage& pose);

/// `cage` with degrees raised where necessary: no segment has a lower degree than the corresponding
/// segment of `other`. Throws Error if the two have different numbers of segments or holes.
Cage elevated_to(const Cage& cage, const Cage& other);

/// The loops as polylines. Segments of degree 1 are sampled only at their start, all others at
/// `per_curve` parameters.
Polygon outline_of(const Cage& cage, int per_curve = 16);

/// The loops as polygons, accurate to 5e-5 of the cage's diagonal: the vertices of the polygons and
/// their locations on the cage. Straight segments are not divided. Curved segments are divided
/// evenly in the parameter, into at most 1024 pieces.
struct FlatCage : Polygon {
  std::vector<BoundaryPoint> locations;

  /// The point on the cage that belongs to a point on an edge of the polygon: parameter t on edge
  /// i.
  BoundaryPoint on_edge(Index i, double t) const;
};
FlatCage flattened(const Cage& cage);

/// Finds the parts of a cage that contain points.
class PartFinder {
 public:
  explicit PartFinder(const Cage& cage);
  /// The part that contains z, or the nearest one. Cost: linear; constant if there is one part.
  Index at(Complex z) const;
  const FlatCage& outline(Index part) const { return outlines_[static_cast<size_t>(part)]; }

 private:
  std::vector<FlatCage> outlines_;
};

/// The point on the cage nearest to z. `flat` is the flattened cage. Costs as much as
/// nearest_on_polygon.
BoundaryPoint nearest_on(const Cage& cage, const FlatCage& flat, Complex z);

/// The same cage with one loop, or with all loops, traversed backward from the same first vertex.
Cage reversed(const Cage& cage, Index loop);
Cage reversed(const Cage& cage);

/// Returns z unless it is a vertex of the cage, whose inside must be on its left. For a vertex,
/// returns an interior point at a distance of 1e-9 times the shorter edge. Derivatives that are
/// infinite at the vertex are evaluated at this point instead.
Complex point_inside_vertex(const Cage& cage, Complex z);

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
/// vertex's loop must have more than three segments.
void erase_vertex(Cage& cage, Index vertex, double joint, Refit refit = Refit::curve);

/// Adds a hole of a part with these segments after its other holes.
void add_hole(Cage& cage, const std::vector<Points>& segments, Index part = 0);
/// Removes loop `loop` >= 1, which is a hole.
void erase_hole(Cage& cage, Index loop);
/// Adds the outline and the holes of a cage with one part as a further part.
void add_part(Cage& cage, const Cage& part);
/// Removes one of several parts with its holes.
void erase_part(Cage& cage, Index part);
/// The loops of a part, from `first` to before `end`.
struct LoopRange {
  Index first, end;
};
LoopRange loops_of_part(const Cage& cage, Index part);
/// A part as a cage of its own.
Cage part_of(const Cage& cage, Index part);
/// One loop as a cage of its own.
Cage loop_of(const Cage& cage, Index loop);

/// Whether every segment is a straight edge traversed at constant speed. Edges of raised degree
/// count as straight.
bool is_straight(const Cage& cage);

/// Whether segment `segment` is a straight edge traversed at constant speed.
bool is_straight(const Cage& cage, Index segment);

/// Throws Error unless the cage can be a rest cage. Each loop must have at least three segments,
/// finite coordinates and a nonzero area. It must not have a segment of zero length, a cusp, a
/// needle below 1e-7 radians or a self-intersection. Needles are refused because the points that a
/// mesher inserts on their sides are rounded, which makes the sides cross. Holes must lie inside
/// the outline of their part and outside each other, parts outside each other or in holes, and no
/// two loops may touch. The message names the
/// segments, and the error's `where` is the position. Needles, intersections and areas are tested
/// on the `flattened` cage. Cost for ordinary loops: O(n log n) in the number of flattened points.
void check_rest_cage(const Cage& cage);

/// The error that check_rest_cage would throw, or none if the cage is valid.
std::optional<Error> rest_fault(const Cage& cage);

/// A point as written in messages: "(12, 30.5)".
std::string point_text(Complex z);

}  // namespace holomorph
