// Random smooth and limbed outlines. A seed gives the same outline on every machine.
#pragma once

#include <cmath>
#include <random>

#include "core/geometry/polyline.h"

namespace outlines {

using namespace holomorph;

/// A star-shaped polygon, about 600 across: a circle whose radius is modulated by a few waves. With
/// `limbs`, the radius is the exponential of the waves, which makes the limbs long and thin.
inline Points random(unsigned seed, bool limbs, int points) {
  std::mt19937 random(seed);
  const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1; };
  constexpr int kWaves = 8;
  double c[kWaves + 1] = {}, s[kWaves + 1] = {};
  for (int k = 2; k <= kWaves; ++k) {
    c[k] = number() / (k * (limbs ? 1.4 : 2.2));
    s[k] = number() / (k * (limbs ? 1.4 : 2.2));
  }
  Points outline;
  for (int i = 0; i < points; ++i) {
    const double t = 2 * kPi * i / points;
    double radius = 1;
    for (int k = 2; k <= kWaves; ++k) radius += c[k] * std::cos(k * t) + s[k] * std::sin(k * t);
    radius = limbs ? std::exp(radius - 1) : std::max(radius, 0.25);
    outline.push_back(300 * radius * std::polar(1.0, t));
  }
  return outline;
}

/// Points along the same curve, including its corners, that are at most `step` apart.
inline Points with_steps(const Polyline& line, double step) {
  Points points;
  const Points& from = line.points();
  for (Index i = 0; i < line.segments(); ++i) {
    const Complex a = from[static_cast<size_t>(i)],
                  b = from[static_cast<size_t>(i + 1) % from.size()];
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(b - a) / step)));
    for (int k = 0; k < parts; ++k) points.push_back(a + static_cast<double>(k) / parts * (b - a));
  }
  if (!line.closed()) points.push_back(from.back());
  return points;
}

}  // namespace outlines
