// A polyline with a fast nearest-point search: the target curve of outlines and strokes.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class Polyline {
 public:
  /// Takes at least two points, or three if closed. Neighboring points must differ. Cost: linear.
  Polyline(Points points, bool closed);

  struct Nearest {
    Complex point;
    Index segment = 0;
    double parameter = 0;  ///< 0 to 1 along the segment
    double distance = 0;
  };
  /// The point nearest to z. `hint` is a segment that is likely to be near, such as the segment of
  /// the previous result. Cost: logarithmic in the number of segments if the hint is good.
  Nearest nearest(Complex z, Index hint = 0) const;

  const Points& points() const { return points_; }
  bool closed() const { return closed_; }
  Index segments() const { return static_cast<Index>(points_.size()) - (closed_ ? 0 : 1); }
  double length() const { return lengths_.back(); }
  /// The point at the given arc length from the first point. The length wraps around on a closed
  /// curve and is clamped on an open one.
  Complex at(double length) const;
  /// A point on the polyline, as a segment and the parameter on it.
  struct Location {
    Index segment = 0;
    double parameter = 0;
  };
  Location location_at(double length) const;
  /// The arc length of a point on a segment.
  double length_at(Index segment, double parameter) const;
  /// The diagonal of the bounding box.
  double diagonal() const;
  /// The largest distance between two points, or up to 0.05 % less. Cost: linear.
  double diameter() const;

 private:
  struct Box {
    double left, bottom, right, top;
  };
  void search(Complex z, Index node, Index first, Index count, Nearest& best) const;
  void try_segment(Complex z, Index segment, Nearest& best) const;
  Box build(Index node, Index first, Index count);
  Complex start(Index segment) const { return points_[static_cast<size_t>(segment)]; }
  Complex end(Index segment) const {
    return points_[static_cast<size_t>(segment + 1) % points_.size()];
  }

  Points points_;
  bool closed_;
  std::vector<double> lengths_;  ///< arc lengths from the first point to each point and to the end
  std::vector<Box> boxes_;       ///< bounding boxes in a binary tree over consecutive segments
};

/// The points without consecutive duplicates.
Points without_repeats(const Points& points);

/// Throws Error unless all points are finite and at least two of them differ.
void check_stroke(std::span<const Complex> points);

/// `count` points at equal distances in arc length. On an open curve, they include both ends.
Points at_equal_lengths(const Polyline& line, Index count);

/// The largest distance from b, taken over the corners of a and the midpoints of its segments.
double one_sided_distance(const Polyline& a, const Polyline& b);

}  // namespace holomorph
