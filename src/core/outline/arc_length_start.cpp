// The only unknown is the shift between the two starting points. 200 values are tried.
#include "core/outline/arc_length_start.h"

namespace holomorph {
namespace {

constexpr Index kPhases = 200;

/// Equal fractions of both lengths. The source's start corresponds to the point whose arc length on
/// the target is `shift` / kPhases of the target's length.
Correspondence by_equal_fractions(const Polyline& source, const Polyline& target, Index shift) {
  const double offset = target.length() * static_cast<double>(shift) / kPhases;
  return {{{0, 0.5 * source.length()},
           {offset, offset + 0.5 * target.length()},
           source.length(),
           target.length()}};
}

Complex mean(const Points& points) {
  Complex sum = 0;
  for (const Complex& z : points) sum += z;
  return sum / static_cast<double>(points.size());
}

/// The angle by which a curve has turned at equally spaced points, once around.
std::vector<double> turning(const Polyline& curve) {
  const Points points = at_equal_lengths(curve, kPhases);
  const auto chord = [&](Index i) {
    const auto at = [&](Index k) { return points[static_cast<size_t>(k % kPhases)]; };
    return at(i + 1) - at(i);
  };
  std::vector<double> turned{0};
  for (Index i = 1; i < kPhases; ++i)
    turned.push_back(turned.back() + std::arg(chord(i) / chord(i - 1)));
  return turned;
}

}  // namespace

Correspondence by_arc_length(const Polyline& source, const Polyline& target) {
  const Points from = at_equal_lengths(source, kPhases), to = at_equal_lengths(target, kPhases);
  const Complex center_from = mean(from), center_to = mean(to);
  Index best = 0;
  double least = INFINITY;
  for (Index shift = 0; shift < kPhases; ++shift) {
    double sum = 0;
    for (Index i = 0; i < kPhases; ++i)
      sum += std::norm(from[static_cast<size_t>(i)] - center_from -
                       to[static_cast<size_t>((i + shift) % kPhases)] + center_to);
    if (sum < least) least = sum, best = shift;
  }
  return by_equal_fractions(source, target, best);
}

Correspondence by_turning(const Polyline& source, const Polyline& target) {
  const std::vector<double> from = turning(source), to = turning(target);
  Index best = 0;
  double least = INFINITY;
  for (Index shift = 0; shift < kPhases; ++shift) {
    double sum = 0, squares = 0;
    for (Index i = 0; i < kPhases; ++i) {
      const Index k = i + shift;
      const double off = to[static_cast<size_t>(k % kPhases)] + (k < kPhases ? 0 : 2 * kPi) -
                         from[static_cast<size_t>(i)];
      sum += off, squares += off * off;
    }
    const double variance = squares - sum * sum / kPhases;
    if (variance < least) least = variance, best = shift;
  }
  return by_equal_fractions(source, target, best);
}

}  // namespace holomorph
