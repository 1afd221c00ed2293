// Where rows of pixels cross the edges of triangles. The triangles at both sides of an edge compute
// exactly the same crossing, so neighbors neither overlap nor leave a gap.
#pragma once

#include <algorithm>
#include <cmath>

namespace holomorph {

/// The x at which the edge from (ax, ay) to (bx, by) crosses height y. Exchanging the endpoints
/// gives exactly the same value.
inline double crossing(double ax, double ay, double bx, double by, double y) {
  if (by < ay || (by == ay && bx < ax)) std::swap(ax, bx), std::swap(ay, by);
  return ax + (bx - ax) * ((y - ay) / (by - ay));
}

/// Finds the half-open interval of x that the triangle with these corners covers at height y.
/// Returns false if it is empty.
inline bool span_at(const double (&x)[3], const double (&y)[3], double height, double& left,
                    double& right) {
  double found[3];
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const int m = (k + 1) % 3;
    if ((y[k] <= height) != (y[m] <= height))
      found[count++] = crossing(x[k], y[k], x[m], y[m], height);
  }
  if (count < 2) return false;
  left = std::min(found[0], found[1]);
  right = std::max(found[0], found[1]);
  return left < right;
}

/// The smallest integer i with i + 0.5 >= x.
inline int first_center(double x) {
  return static_cast<int>(std::ceil(x - 0.5));
}

}  // namespace holomorph
