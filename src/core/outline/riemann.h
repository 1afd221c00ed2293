// Riemann maps of polygons by their boundary: the geodesic zipper (Marshall, Rohde 2007).
//
// The domain is opened along its boundary arc by arc, each a geodesic of what is left of the plane,
// until it is the upper half-plane. After each arc the center goes back to i and the end of the
// boundary so far to 0, so that only what the center hardly sees is lost to rounding.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class RiemannMap {
 public:
  /// For the inside of a simple polygon in counter-clockwise order, three vertices at least, of
  /// which each edge is one arc: the finer the polygon, the nearer the map to that of a smooth
  /// curve through the vertices. `center` is the inner point that goes to 0. Throws Error where the
  /// polygon's vertices coincide. Cost: half of vertices^2 square roots.
  RiemannMap(std::span<const Complex> polygon, Complex center);

  /// To the unit disk; for points inside. Cost: one square root for each vertex.
  Complex at(Complex z) const;
  /// Where the polygon's vertices go on the unit circle: arguments, increasing, the first one in
  /// (-pi, pi], the last one less than 2 pi above it.
  const VectorXd& angles() const { return angles_; }
  /// The steps from each vertex's angle to the next one's, precise however small they are.
  const VectorXd& steps() const { return steps_; }

 private:
  struct Arc {
    double scale = 1, inverse_b = 0;  ///< z -> scale z / (1 - z / b) straightens the arc
    double c = 0;                     ///< and this is its height
  };
  /// Boundary points that are open, on the real axis in their order, the last one at 0, and the
  /// differences between neighbors: those stay exact where the points themselves cannot be told
  /// apart.
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
  Complex center_;  ///< in the half-plane
  VectorXd angles_, steps_;
};

}  // namespace holomorph
