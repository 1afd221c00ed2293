// Shapes that tests share.
#pragma once

#include <cmath>
#include <random>

#include "core/geometry/cage.h"

namespace holomorph::shapes {

inline Points rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

inline Points l_shape() {
  return {{0, 0}, {200, 0}, {200, 100}, {100, 100}, {100, 200}, {0, 200}};
}

/// A star-shaped polygon around (200, 200) with `n` vertices and radii within 100 (1 +- ripple).
inline Points star(int n, double ripple, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(1 - ripple, 1 + ripple);
  Points polygon;
  for (int i = 0; i < n; ++i)
    polygon.push_back(Complex(200, 200) +
                      100.0 * radius(random) * std::polar(1.0, 2 * kPi * i / n));
  return polygon;
}

/// A star whose edges are curves of the given degree. Their control points are off the chord by up
/// to `bulge` times its length.
inline Cage curved_star(int n, int degree, double bulge, unsigned seed) {
  const Points polygon = star(n, 0.15, seed);
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> off(-bulge, bulge);
  Cage cage = polygon_cage(polygon);
  for (Index e = 0; e < cage.size(); ++e) {
    const Complex a = polygon[e], side = polygon[(e + 1) % polygon.size()] - a;
    for (int m = 1; m < degree; ++m) {
      const double across = off(random), along = (m + 0.2 * off(random)) / degree;
      cage.segments[e].push_back(a + side * Complex(along, across));
    }
  }
  return cage;
}

/// A comb with many thin teeth.
inline Points comb(int teeth) {
  Points polygon{{0, 0}};
  for (int i = 0; i < teeth; ++i) {
    polygon.push_back({20.0 * i + 18, 0});
    if (i + 1 < teeth) {
      polygon.push_back({20.0 * i + 18, 80});
      polygon.push_back({20.0 * i + 20, 80});
      polygon.push_back({20.0 * i + 20, 0});
    }
  }
  polygon.push_back({20.0 * teeth - 2, 100});
  polygon.push_back({0, 100});
  return polygon;
}

}  // namespace holomorph::shapes
