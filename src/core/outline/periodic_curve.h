// Increasing functions through given points, once around to once around: smooth, and never falling
// between the points.
#pragma once

#include "core/types.h"

namespace holomorph {

/// The piecewise cubic through (x, y) with the slopes of Fritsch and Butland (1984): increasing
/// wherever the points are, y(t + x_period) = y(t) + y_period. Both lists increase, within one
/// period, and are as long; one point at least.
struct PeriodicCurve {
  std::vector<double> x, y;
  double x_period = 0, y_period = 0;

  /// Cost: logarithmic in the points.
  double operator()(double t) const;
  /// The t where the curve has a value, to rounding. Cost: 60 evaluations of a cubic.
  double inverse_at(double value) const;
  /// The curve through the points (y, x), which is the inverse at those.
  PeriodicCurve through_inverse() const { return {y, x, y_period, x_period}; }

 private:
  /// One piece: the value at a share of its width.
  struct Piece {
    double from = 0, width = 0, value = 0, rise = 0, left = 0, right = 0;
    double operator()(double share) const;
  };
  Piece piece(Index i) const;
};

}  // namespace holomorph
