// Riemann maps of polygons, computed along the boundary: the geodesic zipper (Marshall, Rohde
// 2007).
//
// The boundary is opened arc by arc until the domain is the upper half-plane. Each arc is a
// geodesic of the remaining part of the plane. After each arc, the center is moved back to i and
// the end of the opened boundary to 0. Rounding therefore affects only parts of the boundary with a
// very small harmonic measure from the center.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class RiemannMap {
 public:
  /// Maps the interior of a simple polygon in counter-clockwise order with at least three vertices.
  /// Each edge is replaced by one arc. The finer the polygon, the closer the result is to the
  /// Riemann map of a smooth curve through the vertices. `center` is the interior point that is
  /// mapped to 0. Throws Error if vertices of the polygon coincide. Cost: vertices^2 / 2 square
  /// roots.
  RiemannMap(std::span<const Complex> polygon, Complex center);

  /// The image of an interior point in the unit disk. Cost: one square root for each vertex.
  Complex at(Complex z) const;
  /// Arguments of the vertices' images on the unit circle, in increasing order. The first is in
  /// (-pi, pi]; the last exceeds the first by less than 2 pi.
  const VectorXd& angles() const { return angles_; }
  /// The differences between the angles of consecutive vertices, accurate even if they are tiny.
  const VectorXd& steps() const { return steps_; }

 private:
  struct Arc {
    double scale = 1, inverse_b = 0;  ///< z -> scale z / (1 - z / b) straightens the arc
    double c = 0;                     ///< the height of the straightened arc
  };
  /// Opened boundary points, in order on the real axis with the last point at 0, and the
  /// differences between neighbors. The differences stay accurate even where the points themselves
  /// coincide to within rounding.
  struct OpenPoints {
    std::vector<double> at, steps;
    void open(const Arc& arc);
  };
  static Complex straightened(const Arc& arc, Complex z);
  static Complex open(const Arc& arc, Complex z);
  static Arc centering(Complex z);
  Complex first_root(Complex z) const;
  void set_angles(const OpenPoints& points);
  Complex in_half_plane(Complex z) const;

  Complex first_, second_;  ///< vertices
  std::vector<Arc> arcs_;
  Arc last_;        ///< takes the first vertex to infinity
  Complex center_;  ///< image of the center in the half-plane
  VectorXd angles_, steps_;
};

}  // namespace holomorph
