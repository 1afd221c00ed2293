// The candidates are the vertices and the feet of the perpendiculars from z. The parameter of such
// a foot is the real part of a root.
#include "core/geometry/contact.h"

#include <algorithm>
#include <array>
#include <limits>

namespace holomorph {

double rounding_of(const SegmentPolynomial& segment, Complex z, double s, double q) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  if (!segment.is_straight())
    return (4 + segment.degree()) * kEpsilon * std::max(segment.magnitude(), std::abs(z));
  // The end points are exact.
  const double along = std::abs(segment.end() - segment.start()) * std::max(0.0, std::min(s, q));
  return kEpsilon * (4 * std::abs(z) + 6 * along);
}

namespace {

/// The segment that starts where segment e ends. It need not be the next one, because the last
/// segment of a loop ends at the loop's start.
size_t next_of(std::span<const SegmentPolynomial> loops, size_t e) {
  if (e + 1 < loops.size() && loops[e + 1].start() == loops[e].end()) return e + 1;
  const auto found = std::ranges::find(loops, loops[e].end(), &SegmentPolynomial::start);
  return static_cast<size_t>(found - loops.begin()) % loops.size();
}

}  // namespace

Contact contact_at(std::span<const SegmentPolynomial> loops, Index segment, double t) {
  const SegmentPolynomial& curve = loops[static_cast<size_t>(segment)];
  if (t == 0) return {segment, 0, 1, curve.start()};
  return {segment, t, 1 - t, curve.fine_at({t, 1 - t})};
}

std::optional<Contact> contact_of(std::span<const SegmentPolynomial> loops, Complex z,
                                  double outside) {
  std::optional<Contact> nearest;
  double distance = std::numeric_limits<double>::infinity();
  std::array<Root, kHighestDegree> storage;
  for (size_t e = 0; e < loops.size(); ++e) {
    const SegmentPolynomial& segment = loops[e];
    const double rounding = outside * rounding_of(segment, z, 0.5, 0.5);
    const Box& box = segment.box();
    if (z.real() < box.left - rounding || z.real() > box.right + rounding ||
        z.imag() < box.bottom - rounding || z.imag() > box.top + rounding)
      continue;
    const Index number = static_cast<Index>(e);
    const double at_end = outside * rounding_of(segment, z, 0, 1);
    if (const double here = std::abs(z - segment.start()); here <= at_end && here < distance) {
      distance = here;
      nearest = Contact{number, 0, 1, segment.start()};
    }
    if (const double here = std::abs(z - segment.end()); here <= at_end && here < distance) {
      distance = here;
      const size_t next = next_of(loops, e);
      nearest = Contact{static_cast<Index>(next), 0, 1, loops[next].start()};
    }
    const std::span<Root> roots(storage.data(), static_cast<size_t>(segment.degree()));
    segment.roots(z, roots);
    for (const Root& root : roots) {
      const double s = root.s.real(), q = root.q.real();
      if (!(s > 0) || !(q > 0)) continue;
      const double here = std::abs(root.s.imag()) * std::abs(segment.derivative(root));
      const double most = rounding_of(segment, z, s, q) * (root.s.imag() < 0 ? outside : 1);
      if (!(here <= most) || !(here < distance)) continue;
      distance = here;
      nearest = Contact{number, s, q, segment.fine_at({s, q})};
    }
  }
  return nearest;
}

}  // namespace holomorph
