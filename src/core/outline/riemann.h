// Riemann maps of polygons, computed along the boundary: the geodesic zipper (Marshall, Rohde
// 2007).
//
// The boundary is opened arc by arc, each a geodesic of the remaining part of the plane, until the
// domain is the upper half-plane. After each arc, the center is moved back to i and the end of the
// opened boundary to 0. Rounding therefore affects only parts of the boundary with a very small
// harmonic measure from the center.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class RiemannMap {
 public:
  /// For the interior of a simple polygon in counter-clockwise order with at least three vertices.
  /// Each edge is one arc: the finer the polygon, the closer the map is to that of a smooth curve
  /// through the vertices. `center` is the interior point that goes to 0. Throws Error where the
  /// polygon's vertices coincide. Cost: vertices^2 / 2 square roots.
  RiemannMap(std::span<const Complex> polygon, Complex center);

  /// The image in the unit disk of a point inside. Cost: one square root for each vertex.
  Complex at(Complex z) const;
  /// Arguments of the images of the polygon's vertices on the unit circle. They increase; the first
  /// is in (-pi, pi], the last is less than 2 pi above it.
  const VectorXd& angles() const { return angles_; }
  /// The differences from each vertex's angle to the next one's, accurate however small they are.
  const VectorXd& steps() const { return steps_; }

 private:
  struct Arc {
    double scale = 1, inverse_b = 0;  ///< z -> scale z / (1 - z / b) straightens the arc
    double c = 0;                     ///< the height of the straightened arc
  };
  /// Opened boundary points, in order on the real axis with the last one at 0, and the differences
  /// between neighbors. The differences stay accurate even where the points themselves coincide to
  /// within rounding.
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
  Complex center_;  ///< its image in the half-plane
  VectorXd angles_, steps_;
};

}  // namespace holomorph
