// A cubic function on a triangle, in Bezier form.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.h"

namespace holomorph {

/// Has ten Bezier points, at (i, j, k) with i + j + k = 3; k is left out. Value type.
class TriangleCubic {
 public:
  Complex& operator()(int i, int j) { return points_[static_cast<size_t>(4 * i + j)]; }
  Complex operator()(int i, int j) const { return points_[static_cast<size_t>(4 * i + j)]; }

  /// The value at barycentric coordinates u + v + w = 1.
  Complex at(double u, double v, double w) const {
    const TriangleCubic& b = *this;
    return u * u * (u * b(3, 0) + 3 * v * b(2, 1) + 3 * w * b(2, 0)) +
           v * v * (v * b(0, 3) + 3 * u * b(1, 2) + 3 * w * b(0, 2)) +
           w * w * (w * b(0, 0) + 3 * u * b(1, 0) + 3 * v * b(0, 1)) + 6 * u * v * w * b(1, 1);
  }

  bool is_finite() const { return std::ranges::all_of(points_, holomorph::is_finite); }

  /// The largest second difference in the direction of an edge, or 4 / 9 of the sum over the
  /// three directions if that is more: linear interpolation misses a quadratic by an eighth of
  /// the former at the middle of an edge, and by an eighteenth of the sum at the mean of the
  /// corners.
  double bend() const {
    const TriangleCubic& b = *this;
    double most = 0, sum = 0;
    for (const auto [i, j] : {std::array{1, 0}, {0, 1}, {0, 0}}) {
      const double uv = std::abs(b(i + 2, j) - 2.0 * b(i + 1, j + 1) + b(i, j + 2)),
                   uw = std::abs(b(i + 2, j) - 2.0 * b(i + 1, j) + b(i, j)),
                   vw = std::abs(b(i, j + 2) - 2.0 * b(i, j + 1) + b(i, j));
      most = std::max({most, uv, uw, vw});
      sum = std::max(sum, uv + uw + vw);
    }
    return std::max(most, sum * 4 / 9);
  }

 private:
  std::array<Complex, 16> points_{};
};

}  // namespace holomorph
