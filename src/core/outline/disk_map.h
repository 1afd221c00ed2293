// Automorphisms of the unit disk, and its hyperbolic metric.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "core/types.h"

namespace holomorph {

/// The automorphism of the disk that takes three points of the circle to three other points. All
/// points are given by their angles.
class DiskMap {
 public:
  DiskMap(const std::array<double, 3>& from, const std::array<double, 3>& to) {
    const Eigen::Matrix2cd a = to_line(from), b = to_line(to);
    Eigen::Matrix2cd inverse;
    inverse << b(1, 1), -b(0, 1), -b(1, 0), b(0, 0);
    m_ = inverse * a;
  }
  Complex operator()(Complex z) const {
    return (m_(0, 0) * z + m_(0, 1)) / (m_(1, 0) * z + m_(1, 1));
  }
  /// The angle of the image of a point of the circle.
  double angle(Complex z) const {
    const Complex above = m_(0, 0) * z + m_(0, 1), below = m_(1, 0) * z + m_(1, 1);
    return std::arg(above * std::conj(below));
  }
  DiskMap inverse() const {
    DiskMap other = *this;
    other.m_ << m_(1, 1), -m_(0, 1), -m_(1, 0), m_(0, 0);
    return other;
  }

 private:
  /// Takes three points of the circle to 0, 1 and infinity.
  static Eigen::Matrix2cd to_line(const std::array<double, 3>& angles) {
    const Complex p = std::polar(1.0, angles[0]), q = std::polar(1.0, angles[1]),
                  r = std::polar(1.0, angles[2]);
    Eigen::Matrix2cd m;
    m << (q - r), -p * (q - r), (q - p), -r * (q - p);
    return m;
  }
  Eigen::Matrix2cd m_;
};

/// The squared hyperbolic distance between two points of the unit disk.
inline double hyperbolic_square(Complex z, Complex w) {
  constexpr double kFarthest = 1 - 1e-9;
  const double rho = std::abs((z - w) / (1.0 - std::conj(w) * z));
  const double distance = 2 * std::atanh(std::min(rho, kFarthest));
  return distance * distance;
}

}  // namespace holomorph
