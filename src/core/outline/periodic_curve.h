// Smooth functions through increasing points. They map one period to one period and never decrease
// between the points.
#pragma once

#include "core/types.h"

namespace holomorph {

/// The piecewise cubic through (x, y) with the slopes of Fritsch and Butland (1984). It increases
/// wherever the points do, and y(t + x_period) = y(t) + y_period. Both lists increase within one
/// period and have the same length, at least one.
struct PeriodicCurve {
  std::vector<double> x, y;
  double x_period = 0, y_period = 0;

  /// Cost: logarithmic in the number of points.
  double operator()(double t) const;
  /// The t at which the curve has this value, accurate to rounding. Cost: 60 evaluations of a
  /// cubic.
  double inverse_at(double value) const;
  /// The curve through the points (y, x). It agrees with the inverse function at these points.
  PeriodicCurve through_inverse() const { return {y, x, y_period, x_period}; }

 private:
  /// One piece; it is evaluated at a fraction of its width.
  struct Piece {
    double from = 0, width = 0, value = 0, rise = 0, left = 0, right = 0;
    double operator()(double fraction) const;
  };
  Piece piece(Index i) const;
};

}  // namespace holomorph
