// Where an outline is sampled for its Riemann map: densely where it is thin and at corners.
#pragma once

#include "core/geometry/polyline.h"

namespace holomorph {

/// The vertices of a closed polyline that are corners of a drawing rather than points of a smooth
/// curve: those that turn by more than this.
inline constexpr double kCorner = kPi / 6;

/// By how much a closed polyline turns at a vertex.
double turn_at(const Polyline& outline, Index vertex);

/// The arc lengths of a closed polyline's corners.
std::vector<double> corners_of(const Polyline& curve);

/// Radii of the largest disks that touch a closed polyline from either side, the smaller one: half
/// of the local thickness of what is inside and outside.
class Thickness {
 public:
  /// Cost: a third of a million operations.
  explicit Thickness(const Polyline& outline);
  /// At an arc length.
  double operator()(double length) const;

 private:
  double length_;
  std::vector<double> radii_;  ///< at equal arc lengths
};

/// Increasing arc lengths from `start` on, once around a closed, simple, counter-clockwise
/// polyline: a `count`-th of its length apart at most, less than half of the local thickness (of
/// the inside and the outside), and geometrically closer towards corners, which are among them;
/// nowhere closer than `least` of its length. Cost: a million operations.
std::vector<double> graded_lengths(const Polyline& outline, double start, Index count,
                                   double least);

}  // namespace holomorph
