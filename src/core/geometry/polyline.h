// A curve of straight segments that answers what is nearest: the target of outlines and strokes.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class Polyline {
 public:
  /// Neighboring points must differ; two points at least, three when it closes. Cost: linear.
  Polyline(Points points, bool closed);

  struct Nearest {
    Complex point;
    Index segment = 0;
    double parameter = 0;  ///< 0 to 1 along the segment
    double distance = 0;
  };
  /// The nearest point. `hint` is a segment that is likely to be near, such as the last answer's.
  /// Cost: logarithmic in the segments when the hint is good.
  Nearest nearest(Complex z, Index hint = 0) const;

  const Points& points() const { return points_; }
  bool closed() const { return closed_; }
  Index segments() const { return static_cast<Index>(points_.size()) - (closed_ ? 0 : 1); }
  double length() const { return lengths_.back(); }
  /// The point at an arc length from the first one; closed curves go round, others end.
  Complex at(double length) const;
  /// Where that is: a segment and the parameter on it.
  struct Location {
    Index segment = 0;
    double parameter = 0;
  };
  Location place_at(double length) const;
  /// The arc length of a point on a segment.
  double length_at(Index segment, double parameter) const;
  /// The smallest box's diagonal.
  double diagonal() const;
  /// The largest distance of two points, or up to 0.05 % less. Cost: linear.
  double diameter() const;

 private:
  struct Box {
    double left, bottom, right, top;
  };
  void look(Complex z, Index node, Index first, Index count, Nearest& best) const;
  void look_at(Complex z, Index segment, Nearest& best) const;
  Box build(Index node, Index first, Index count);
  Complex start(Index segment) const { return points_[static_cast<size_t>(segment)]; }
  Complex end(Index segment) const {
    return points_[static_cast<size_t>(segment + 1) % points_.size()];
  }

  Points points_;
  bool closed_;
  std::vector<double> lengths_;  ///< from the first point to each, and to the end
  std::vector<Box> boxes_;       ///< a binary tree over consecutive segments
};

/// The points without those that repeat the one before.
Points without_repeats(const Points& points);

/// Throws Error unless the points are finite, and at two places at least.
void check_stroke(std::span<const Complex> points);

/// `count` points at equal arc lengths; an open curve's ends are among them.
Points at_equal_lengths(const Polyline& line, Index count);

/// The largest distance of a's points (its corners and the middles of its segments) from b.
double one_sided_distance(const Polyline& a, const Polyline& b);

}  // namespace holomorph
