// A smooth map in one triangle, as three cubics (Clough, Tocher 1965).
//
// The triangle is divided at its center into three. Values and derivatives at the corners determine
// the cubics: the derivative across an edge is linear along it, so that neighbors agree there.
#pragma once

#include <limits>

#include "core/arithmetic.h"
#include "core/maps/deformer.h"
#include "core/maps/triangle_cubic.h"

namespace holomorph {

/// A corner of a triangle: its place, and the map's value and derivatives there.
struct SmoothCorner {
  Complex z, f, fz, fzbar;
  Complex along(Complex d) const { return times(fz, d) + times(fzbar, std::conj(d)); }
};

/// A map's distortion in a region: what it attains there, or proved bounds. By default, that of no
/// region.
struct StretchBounds {
  double smallest = kUnbounded, largest = 0;  ///< of the stretches
  double shear = 0;                           ///< the largest |f_zbar / f_z|
  double least_determinant = kUnbounded;

  void include(const StretchBounds& other);

 private:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
};

/// Third k has corner k + 1, corner k + 2 and the center, whose barycentric coordinates are u, v
/// and w.
class CubicThirds {
 public:
  explicit CubicThirds(const std::array<SmoothCorner, 3>& corners);

  /// The map at barycentric coordinates in the triangle, which may lie outside.
  PointMap::Value at(const std::array<double, 3>& weights) const;

  /// What the map attains at the corners of the thirds.
  StretchBounds attained() const;
  /// Bounds from the Bernstein coefficients of the derivatives, which enclose them. Thirds are
  /// divided up to `depth` times where the bounds are more than 1 % worse than what is attained
  /// there and anywhere else.
  StretchBounds bounds(int depth, const StretchBounds& elsewhere = {}) const;
  /// Whether the determinant is proved to be positive, whatever the rounding errors are.
  bool is_positive() const;

  /// Moves the map toward the linear one through the corners, by these parts of the way: on the
  /// edge opposite each corner, and inside.
  void straighten(const std::array<double, 3>& edges, double inside);
  /// The directions in which the map takes the way from a corner to the next one, to the center
  /// and to the one before.
  std::array<Complex, 3> directions(size_t corner) const;

 private:
  std::array<Complex, 3> corners_of(size_t third) const {
    return {z_[(third + 1) % 3], z_[(third + 2) % 3], center_};
  }

  std::array<Complex, 3> z_;
  Complex center_;
  std::array<TriangleCubic, 3> thirds_;
};

}  // namespace holomorph
