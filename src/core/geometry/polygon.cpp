// Orientation tests in extended precision. The 11 additional bits give correct signs for
// coordinates up to millions of pixels.
#include "core/geometry/polygon.h"

#include <algorithm>
#include <numeric>

namespace holomorph {

double signed_area(PolygonView polygon) {
  double twice = 0.0;
  const Complex origin = polygon.size() == 0 ? Complex{} : polygon[0];
  polygon.for_each_edge(
      [&](Index, Complex a, Complex b) { twice += cross(a - origin, b - origin); });
  return 0.5 * twice;
}

double area_of(PolygonView polygon) {
  const std::vector<int> around = nesting_of(polygon);
  double area = 0;
  for (Index l = 0; l < polygon.loops().count(); ++l)
    area +=
        (around[static_cast<size_t>(l)] % 2 == 0 ? 1 : -1) * std::abs(signed_area(polygon.loop(l)));
  return area;
}

double perimeter(PolygonView polygon) {
  double length = 0.0;
  polygon.for_each_edge([&](Index, Complex a, Complex b) { length += std::abs(b - a); });
  return length;
}

namespace {

/// Sign of the signed area of the triangle (a, b, c).
int orientation(Complex a, Complex b, Complex c) {
  const long double abx = static_cast<long double>(b.real()) - a.real();
  const long double aby = static_cast<long double>(b.imag()) - a.imag();
  const long double acx = static_cast<long double>(c.real()) - a.real();
  const long double acy = static_cast<long double>(c.imag()) - a.imag();
  const long double area = abx * acy - aby * acx;
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Whether z lies between a and b. z must be on the line through both.
bool between(Complex a, Complex b, Complex z) {
  return std::min(a.real(), b.real()) <= z.real() && z.real() <= std::max(a.real(), b.real()) &&
         std::min(a.imag(), b.imag()) <= z.imag() && z.imag() <= std::max(a.imag(), b.imag());
}

/// A common point of the closed segments ab and cd, or none.
std::optional<Complex> common_point(Complex a, Complex b, Complex c, Complex d) {
  const int abc = orientation(a, b, c), abd = orientation(a, b, d);
  const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) {
    const double t = cross(c - a, d - c) / cross(b - a, d - c);
    return a + t * (b - a);
  }
  if (abc == 0 && between(a, b, c)) return c;
  if (abd == 0 && between(a, b, d)) return d;
  if (cda == 0 && between(c, d, a)) return a;
  if (cdb == 0 && between(c, d, b)) return b;
  return {};
}

}  // namespace

bool is_left_of(Complex a, Complex b, Complex z) {
  const int side = orientation(a, b, z);
  if (side != 0) return side > 0;
  return b.imag() < a.imag() || (b.imag() == a.imag() && b.real() >= a.real());
}

int winding_number(PolygonView polygon, Complex z) {
  int winding = 0;
  polygon.for_each_edge([&](Index, Complex a, Complex b) {
    if (a.imag() <= z.imag()) {
      if (b.imag() > z.imag() && is_left_of(a, b, z)) ++winding;
    } else if (b.imag() <= z.imag() && !is_left_of(a, b, z)) {
      --winding;
    }
  });
  return winding;
}

std::vector<int> nesting_of(PolygonView polygon) {
  const Index count = polygon.loops().count();
  std::vector<int> around(static_cast<size_t>(count), 0);
  for (Index l = 0; count > 1 && l < count; ++l)
    for (Index other = 0; other < count; ++other)
      around[static_cast<size_t>(l)] +=
          other != l && winding_number(polygon.loop(other), polygon.loop(l)[0]) != 0;
  return around;
}

bool encloses(PolygonView polygon, Complex z) {
  int around = 0;
  for (Index l = 0; l < polygon.loops().count(); ++l)
    around += winding_number(polygon.loop(l), z) != 0;
  return around % 2 == 1;
}

NearestPoint nearest_on_segment(Complex a, Complex b, Complex z) {
  const double length2 = std::norm(b - a);
  const double t = length2 > 0 ? std::clamp(dot(z - a, b - a) / length2, 0.0, 1.0) : 0.0;
  const Complex point = a + t * (b - a);
  return {0, t, point, std::abs(z - point)};
}

NearestPoint nearest_on_polygon(PolygonView polygon, Complex z, Index guess) {
  NearestPoint best;
  best.distance = 1e300;
  if (guess > 0) {
    best = nearest_on_segment(polygon[guess], polygon[polygon.loops().next(guess)], z);
    best.edge = guess;
  }
  // How far a number lies outside of an interval. Most edges are too far away along one axis.
  const auto beyond = [](double x, double from, double to) {
    return std::max(std::min(from, to) - x, x - std::max(from, to));
  };
  polygon.for_each_edge([&](Index edge, Complex a, Complex b) {
    if (beyond(z.real(), a.real(), b.real()) >= best.distance ||
        beyond(z.imag(), a.imag(), b.imag()) >= best.distance)
      return;
    NearestPoint here = nearest_on_segment(a, b, z);
    here.edge = edge;
    if (here.distance < best.distance) best = here;
  });
  return best;
}

std::optional<Crossing> self_crossing(PolygonView polygon) {
  const Loops loops = polygon.loops();
  const auto at = [&](Index i) { return polygon[i]; };
  const auto end = [&](Index e) { return polygon[loops.next(e)]; };
  std::vector<Index> order(static_cast<size_t>(polygon.size()));
  std::iota(order.begin(), order.end(), Index{0});
  const auto left = [&](Index e) { return std::min(at(e).real(), end(e).real()); };
  const auto right = [&](Index e) { return std::max(at(e).real(), end(e).real()); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return left(a) < left(b); });

  const auto cross_at = [&](Index i, Index j) -> std::optional<Complex> {
    const Complex a = at(i), b = end(i), c = at(j), d = end(j);
    // Neighboring edges always share a vertex. They cross only if one folds back onto the other.
    if (loops.next(i) == j)
      return orientation(a, b, d) == 0 && dot(a - b, d - b) > 0 ? std::optional(b) : std::nullopt;
    if (loops.next(j) == i)
      return orientation(c, d, b) == 0 && dot(c - d, b - d) > 0 ? std::optional(d) : std::nullopt;
    return common_point(a, b, c, d);
  };

  std::vector<Index> open;
  for (const Index e : order) {
    const double low = std::min(at(e).imag(), end(e).imag());
    const double high = std::max(at(e).imag(), end(e).imag());
    std::erase_if(open, [&](Index other) { return right(other) < left(e); });
    for (const Index other : open) {
      if (std::max(at(other).imag(), end(other).imag()) < low) continue;
      if (std::min(at(other).imag(), end(other).imag()) > high) continue;
      const Index i = std::min(e, other), j = std::max(e, other);
      if (const auto point = cross_at(i, j)) return Crossing{i, j, *point};
    }
    open.push_back(e);
  }
  return {};
}

double turning_number(PolygonView polygon, Index parts) {
  double total = 0.0;
  const Loops loops = polygon.loops();
  for (Index l = 0; l < loops.count(); ++l) {
    Points edges;
    PolygonView(polygon.loop(l)).for_each_edge([&](Index, Complex a, Complex b) {
      if (b != a) edges.push_back(b - a);
    });
    for (size_t i = 0; i < edges.size(); ++i) {
      const Complex a = edges[i], b = edges[(i + 1) % edges.size()];
      total += std::atan2(cross(a, b), dot(a, b));
    }
  }
  const Index holes = loops.count() - parts;
  return total / (2 * kPi) + static_cast<double>(holes - (parts - 1));
}

}  // namespace holomorph
