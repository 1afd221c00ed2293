#include "core/maps/held_disk.h"

#include <algorithm>
#include <cmath>

#include "core/cauchy/cauchy.h"

namespace holomorph {
namespace {

constexpr double kUsualRadius = 0.03;  // in units of the cage's diagonal

double usual_radius(const Cage& cage) {
  return kUsualRadius * box_of(outline_of(cage).points).diagonal();
}

}  // namespace

double held_radius(const Cage& cage, const RestPin& pin) {
  return pin.radius.value_or(usual_radius(cage));
}

bool sees(PolygonView outline, Complex a, Complex b) {
  bool free = true;
  const Complex way = std::conj(b - a);
  outline.for_each_edge([&](Index, Complex from, Complex to) {
    const Complex p = (from - a) * way, q = (to - a) * way;
    if ((p.imag() > 0) == (q.imag() > 0)) return;
    const double at = p.real() + (q.real() - p.real()) * p.imag() / (p.imag() - q.imag());
    free = free && (at <= 0 || at >= std::norm(way));
  });
  return free;
}

Points held_disk(const Cage& cage, const RestPin& pin) {
  constexpr int kMostRings = 5;
  const Polygon outline = outline_of(cage);
  const double radius = held_radius(cage, pin);
  const int rings = static_cast<int>(
      std::clamp(std::round(radius / usual_radius(cage)), 1.0, double{kMostRings}));
  Points points = {pin.position};
  for (int ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < 6 * ring; ++k) {
      const Complex z = pin.position + std::polar(radius * ring / rings, 2 * kPi * k / (6 * ring));
      if (contains(cage, z) && sees(outline, pin.position, z)) points.push_back(z);
    }
  return points;
}

}  // namespace holomorph
