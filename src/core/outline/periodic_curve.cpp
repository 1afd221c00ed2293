// The slope at a point is a weighted harmonic mean of the slopes of the two chords there.
#include "core/outline/periodic_curve.h"

#include <algorithm>
#include <cmath>

#include "core/arithmetic.h"

namespace holomorph {
namespace {

/// The slope at the point between two chords with these widths and rises.
double slope_between(double before, double rise_before, double after, double rise_after) {
  if (!(before > 0 && after > 0 && rise_before > 0 && rise_after > 0)) return 0;
  const double first = 2 * after + before, second = after + 2 * before;
  return (first + second) / (first * before / rise_before + second * after / rise_after);
}

}  // namespace

double PeriodicCurve::Piece::operator()(double fraction) const {
  const double bump = fraction * (1 - fraction);
  return value + rise * smoothstep(fraction) + bump * ((1 - fraction) * left - fraction * right);
}

PeriodicCurve::Piece PeriodicCurve::piece(Index i) const {
  const Index n = static_cast<Index>(x.size());
  const auto at = [n](const std::vector<double>& list, Index k, double period) {
    const Index around = k < 0 ? -1 : k / n;
    return list[static_cast<size_t>(k - around * n)] + static_cast<double>(around) * period;
  };
  const auto width = [&](Index k) { return at(x, k + 1, x_period) - at(x, k, x_period); };
  const auto rise = [&](Index k) { return at(y, k + 1, y_period) - at(y, k, y_period); };
  const double h = width(i), d = rise(i);
  return {at(x, i, x_period),
          h,
          at(y, i, y_period),
          d,
          slope_between(width(i - 1), rise(i - 1), h, d) * h,
          slope_between(h, d, width(i + 1), rise(i + 1)) * h};
}

double PeriodicCurve::operator()(double t) const {
  const double turns = std::floor((t - x.front()) / x_period);
  t -= turns * x_period;
  const Piece p = piece(std::upper_bound(x.begin(), x.end(), t) - x.begin() - 1);
  if (!(p.width > 0)) return p.value + turns * y_period;
  return p(std::clamp((t - p.from) / p.width, 0.0, 1.0)) + turns * y_period;
}

double PeriodicCurve::inverse_at(double value) const {
  const double turns = std::floor((value - y.front()) / y_period);
  value -= turns * y_period;
  const Piece p = piece(std::upper_bound(y.begin(), y.end(), value) - y.begin() - 1);
  double low = 0, high = 1;
  for (int halving = 0; halving < 60 && p.rise > 0; ++halving) {
    const double middle = 0.5 * (low + high);
    (p(middle) < value ? low : high) = middle;
  }
  return p.from + 0.5 * (low + high) * p.width + turns * x_period;
}

}  // namespace holomorph
