// Riemann maps of polygons by their boundary: the geodesic zipper (Marshall, Rohde 2007).
//
// The domain is opened along its boundary arc by arc, each a geodesic of what is left of the plane,
// until it is the upper half-plane.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

class RiemannMap {
 public:
  /// For the inside of a simple polygon in counter-clockwise order, three vertices at least, of
  /// which each edge is one arc: the finer the polygon, the nearer the map to that of a smooth
  /// curve through the vertices. `centre` is the inner point that goes to 0. Throws Error where the
  /// polygon's vertices coincide. Cost: half of vertices^2 square roots.
  RiemannMap(std::span<const Complex> polygon, Complex centre);

  /// To the unit disk; for points inside. Cost: one square root for each vertex.
  Complex at(Complex z) const;
  /// Where the polygon's vertices go on the unit circle: arguments, increasing, the first one in
  /// (-pi, pi], the last one less than 2 pi above it.
  const VectorXd& angles() const { return angles_; }

 private:
  struct Arc {
    double inverse_b = 0;  ///< z -> z / (1 - z / b) straightens the arc
    double c = 0;          ///< and this is its height
  };
  static Complex open(const Arc& arc, Complex z);
  Complex in_half_plane(Complex z) const;

  Complex first_, second_;  ///< vertices
  std::vector<Arc> arcs_;
  double last_inverse_ = 0;  ///< one over the image of the first vertex before the last step
  Complex centre_;           ///< in the half-plane
  VectorXd angles_;
};

}  // namespace holomorph
