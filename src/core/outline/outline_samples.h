// Samples of an outline for its Riemann map: dense where the outline is thin and near corners.
#pragma once

#include "core/geometry/polyline.h"

namespace holomorph {

/// Vertices of a closed polyline that turn by more than this are corners of the drawing rather than
/// points of a smooth curve.
inline constexpr double kCorner = kPi / 6;

/// The angle by which a closed polyline turns at a vertex.
double turn_at(const Polyline& outline, Index vertex);

/// The arc lengths of a closed polyline's corners.
std::vector<double> corners_of(const Polyline& curve);

/// Half the local thickness of the inside or the outside of a closed polyline, whichever is
/// thinner: the radius of the largest disk that touches the polyline from that side.
class Thickness {
 public:
  /// Cost: a third of a million operations.
  explicit Thickness(const Polyline& outline);
  /// The radius at an arc length.
  double operator()(double length) const;

 private:
  double length_;
  std::vector<double> radii_;  ///< at equally spaced arc lengths
};

/// Increasing arc lengths from `start`, once around a closed, simple, counter-clockwise polyline.
/// The spacing is at most the polyline's length divided by `count`, and less than half the local
/// thickness of the inside and the outside. It decreases geometrically toward the corners, but not
/// below `least` times the length. Corners are always included. Cost: a million operations.
std::vector<double> graded_lengths(const Polyline& outline, double start, Index count,
                                   double least);

}  // namespace holomorph
