// Wavy cages around a center, and scenes with them.
#pragma once

#include "scene/deformation.h"

namespace holomorph::bench {

/// A wavy closed polygon of n vertices.
inline Points wavy(int n, Complex center, double radius) {
  Points polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * kPi * i / n;
    polygon.push_back(center + radius * (1 + 0.25 * std::sin(5 * angle)) * std::polar(1.0, angle));
  }
  return polygon;
}

/// A cage of n segments around (500, 500), each a curve of this degree.
inline Cage wavy_curves(int n, int degree, double bulge) {
  Cage cage = polygon_cage(wavy(n, {500, 500}, 350));
  const Points corners = vertices_of(cage);
  for (Index e = 0; e < cage.size(); ++e) {
    const Complex a = corners[e], side = corners[(e + 1) % corners.size()] - a;
    for (int m = 1; m < degree; ++m)
      cage.segments[e].push_back(
          a + side * Complex(static_cast<double>(m) / degree, m % 2 ? bulge : -bulge));
  }
  return cage;
}

/// A deformation with this polygon as its cage, which the pose bends a little.
inline Deformation scene_with(const Points& polygon) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(polygon);
  for (Points& segment : deformation.pose.segments)
    segment[0] += 20.0 * std::sin(segment[0].imag() / 100);
  return deformation;
}

}  // namespace holomorph::bench
