// A smooth map in one triangle, as three cubics (Clough, Tocher 1965).
//
// The triangle is divided at its center into three. Values and derivatives at the corners determine
// the cubics: the derivative across an edge is linear along it, so that neighbors agree there.
#pragma once

#include "core/maps/deformer.h"
#include "core/maps/triangle_cubic.h"

namespace holomorph {

/// A corner of a triangle: its place, and the map's value and derivatives there.
struct SmoothCorner {
  Complex z, f, fz, fzbar;
  Complex along(Complex d) const { return fz * d + fzbar * std::conj(d); }
};

/// Proved bounds on a map's distortion in a region.
struct StretchBounds {
  double smallest = 0, largest = 0;  ///< of the stretches: lower and upper bound
  double shear = 0;                  ///< upper bound of |f_zbar / f_z|
  double least_determinant = 0;      ///< lower bound of the Jacobian determinant
};

/// Third k has corner k + 1, corner k + 2 and the center, whose barycentric coordinates are u, v
/// and w.
class CubicThirds {
 public:
  explicit CubicThirds(const std::array<SmoothCorner, 3>& corners);

  /// The map at barycentric coordinates in the triangle, which may lie outside.
  PointMap::Value at(const std::array<double, 3>& weights) const;

  /// Bounds from the Bernstein coefficients of the derivatives, which enclose them. Thirds are
  /// divided up to `depth` times where this may improve the bounds.
  StretchBounds bounds(int depth) const;
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
