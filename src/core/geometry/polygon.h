// Polygons, which may have holes and several parts.
#pragma once

#include <optional>
#include <span>

#include "core/geometry/loops.h"

namespace holomorph {

/// Closed polylines in a single list, of which none cross: an outline, and then its holes, for each
/// part. A point is inside if an odd number of loops go around it. Value type.
struct Polygon {
  Points points;
  std::vector<Index> starts = {};  ///< of the loops after the first one

  Points::const_iterator begin() const { return points.begin(); }
  Points::const_iterator end() const { return points.end(); }
};

/// A view of a polygon. Any list of points is a polygon without holes.
class PolygonView {
 public:
  PolygonView(const Points& points) : points_(points) {}
  PolygonView(std::span<const Complex> points) : points_(points) {}
  PolygonView(std::span<const Complex> points, std::span<const Index> starts)
      : points_(points), starts_(starts) {}
  PolygonView(const Polygon& polygon) : points_(polygon.points), starts_(polygon.starts) {}

  std::span<const Complex> points() const { return points_; }
  Index size() const { return static_cast<Index>(points_.size()); }
  Complex operator[](Index i) const { return points_[static_cast<size_t>(i)]; }
  Loops loops() const { return {size(), starts_}; }
  /// One loop alone.
  std::span<const Complex> loop(Index i) const {
    const Loops all = loops();
    return points_.subspan(static_cast<size_t>(all.first(i)), static_cast<size_t>(all.length(i)));
  }
  /// Calls visit(i, a, b) for the edge from point i, at a, to the next point of its loop, at b.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    const Loops all = loops();
    for (Index l = 0; l < all.count(); ++l)
      for (Index i = all.first(l), end = all.end(l); i < end; ++i)
        visit(i, (*this)[i], (*this)[i + 1 < end ? i + 1 : all.first(l)]);
  }

 private:
  std::span<const Complex> points_;
  std::span<const Index> starts_;
};

/// The sum of the signed areas of all loops. The area of a loop is positive if it is
/// counter-clockwise.
double signed_area(PolygonView polygon);
/// The number of other loops that go around each loop: even for outlines, odd for holes.
std::vector<int> nesting_of(PolygonView polygon);
/// The area inside, whatever the orientations of the loops.
double area_of(PolygonView polygon);

/// The length of all loops.
double perimeter(PolygonView polygon);

/// Whether z is to the left of the line from a to b. Points on the line count as left or right, as
/// they do in winding_number().
bool is_left_of(Complex a, Complex b, Complex z);
/// The sum of the winding numbers of all loops around z. Points on the boundary may count as inside
/// or outside.
int winding_number(PolygonView polygon, Complex z);
/// Whether z is inside, whatever the orientations of the loops.
bool encloses(PolygonView polygon, Complex z);

/// The nearest point on a polyline: the edge from vertex `edge` to the next vertex, the parameter
/// on this edge, the position and the distance.
struct NearestPoint {
  Index edge = 0;
  double t = 0.0;
  Complex point;
  double distance = 0.0;
};
NearestPoint nearest_on_segment(Complex a, Complex b, Complex z);
/// Faster if `guess` is an edge that is near; that the first one is near is not worth saying.
NearestPoint nearest_on_polygon(PolygonView polygon, Complex z, Index guess = 0);

/// Two edges of a polygon that touch or cross, and a point on both.
struct Crossing {
  Index first = 0, second = 0;
  Complex point;
};

/// The first crossing between edges of a polygon, or none. Neighboring edges count as crossing only
/// if they overlap. Method: a sweep over boxes sorted by x. Cost: O(n log n) for ordinary outlines.
std::optional<Crossing> self_crossing(PolygonView polygon);

/// The sum of all exterior angles over 2 pi, plus 1 for each hole and minus 1 for each of the
/// `parts` after the first. It is 1 for a polygon that does not cross itself and has its inside on
/// the left. Edges of zero length are skipped.
double turning_number(PolygonView polygon, Index parts = 1);

}  // namespace holomorph
