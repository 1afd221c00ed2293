// Uses the closed form with the logarithm near a segment, and Gauss-Legendre quadrature elsewhere.
// Cancellation in the closed form grows like the distance to the power of the degree.
#include "core/cauchy/cauchy_map.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/arithmetic.h"
#include "core/cauchy/quadrature.h"
#include "core/geometry/orientation.h"

namespace holomorph {
namespace {

/// A Gauss-Legendre rule that is exact to within rounding error where the modulus of W = q - s is
/// above `from`.
struct Rule {
  double from;
  int nodes;
};
constexpr std::array<Rule, 3> kRules{Rule{8.0, 12}, {2.8, 16}, {1.7, 24}};

Points at_nodes(std::span<const Complex> controls, int count) {
  Points values;
  for (const double t : gauss_rule(count).nodes) values.push_back(bezier_point(controls, t));
  return values;
}

}  // namespace

CauchySum::CauchySum(const Cage& given, const VectorXc& displaced) {
  // The formulas are for cages with their inside on the left.
  const Orientation orientation(given);
  const Cage rest = orientation.turned(given);
  const VectorXc displacement = orientation.turned(given, displaced);
  for (Index e = 0; e < rest.size(); ++e) {
    Points d;
    for (int m = 0; m <= rest.degree(e); ++m) d.push_back(displacement[rest.control_index(e, m)]);
    const Points backwards(d.rbegin(), d.rend());
    Segment segment{
        SegmentPolynomial(rest.controls(e)),
        powers_about_middle(d),
        powers_about_start(d),
        powers_about_start(backwards),
        {at_nodes(d, kRules[0].nodes), at_nodes(d, kRules[1].nodes), at_nodes(d, kRules[2].nodes)},
        0,
        0,
        rest.next(e),
        false};
    for (const Complex& by : d) segment.is_moved = segment.is_moved || by != Complex(0);
    segments_.push_back(std::move(segment));
  }
  for (Index e = 0; e < rest.size(); ++e) {
    const Segment& before = segments_[static_cast<size_t>(rest.before(e))];
    Segment& own = segments_[static_cast<size_t>(e)];
    const Complex in = -before.curve.derivative({1, 0}), out = own.curve.derivative({0, 1});
    const double shorter = std::min(std::abs(own.curve.end() - own.curve.start()),
                                    std::abs(before.curve.end() - before.curve.start()));
    own.inwards = 1e-12 * shorter * interior_bisector(out, in);
    own.reach = 0.05 * shorter;
  }
}

// With v_s = s - q = -W:  integral of d / (v - v_s) over [-1, 1] = d(v_s) L + R(v_s), where
// R = sum d_k sum_{j even < k} 2 / (j + 1) v_s^{k-1-j}. Derivatives are with respect to s:
// dv_s / ds = 2.
CauchySum::ValueAndSlope CauchySum::integral(const Segment& segment, const Root& root, Complex log,
                                             Ends without_poles) {
  const Complex v = root.s - root.q;
  const double size = std::norm(v);
  for (size_t r = 0; r < kRules.size(); ++r) {
    if (size <= kRules[r].from * kRules[r].from) continue;
    const GaussRule& rule = gauss_rule(kRules[r].nodes);
    const Points& d = segment.at_nodes[r];
    ValueAndSlope sum{0, 0};
    for (size_t g = 0; g < d.size(); ++g) {
      const Complex kernel = inverse(rule.nodes[g] - root.s),
                    part = times(rule.weights[g] * d[g], kernel);
      sum.f += part;
      sum.df += times(part, kernel);
    }
    if (without_poles.start) sum.df += times(segment.from_start[0], inverse(root.s));
    if (without_poles.end) sum.df += times(segment.from_end[0], inverse(root.q));
    return sum;
  }
  // Horner's scheme for d(v_s) and its slope.
  Complex d = 0, slope = 0, rest = 0, rest_slope = 0;
  for (size_t k = segment.powers.size(); k-- > 0;) {
    slope = times(slope, v) + d;
    d = times(d, v) + segment.powers[k];
  }
  // R is the integral of the quotient (d(v) - d(v_s)) / (v - v_s) = sum_j e_j v^j, which synthetic
  // division yields. Only even j contribute.
  Complex e = 0, e_slope = 0;
  for (size_t j = segment.powers.size() - 1; j-- > 0;) {
    e_slope = times(e_slope, v) + e;
    e = times(e, v) + segment.powers[j + 1];
    if (j % 2 == 0) {
      rest += 2.0 / static_cast<double>(j + 1) * e;
      rest_slope += 2.0 / static_cast<double>(j + 1) * e_slope;
    }
  }
  // d times the slope of the logarithm, which is -1 / s - 1 / q. Without the pole, d(s) / s becomes
  // (d(s) - d(0)) / s.
  const auto over = [&](const Points& powers, Complex x, bool without_pole) {
    if (!without_pole) return times(d, inverse(x));
    Complex quotient = 0;
    for (size_t k = powers.size() - 1; k > 0; --k) quotient = times(quotient, x) + powers[k];
    return quotient;
  };
  const Complex poles = over(segment.from_start, root.s, without_poles.start) +
                        over(segment.from_end, root.q, without_poles.end);
  return {times(d, log) + rest, 2.0 * (times(slope, log) + rest_slope) - poles};
}

CauchySum::ValueAndSlope CauchySum::at(Complex point) const {
  FinePoint z = point;
  for (const Segment& segment : segments_)
    if (segment.curve.start() == point) {
      z.offset = segment.inwards;
      break;
    }
  ValueAndSlope sum{0, 0};
  double turns = 0, nearest = std::numeric_limits<double>::infinity();
  const Segment* across = nullptr;
  Root crossed;
  std::array<Root, kHighestDegree> roots;
  const auto is_near = [&](const Segment& segment) {
    return std::norm(segment.curve.start() - z) < segment.reach * segment.reach;
  };
  for (size_t e = 0; e < segments_.size(); ++e) {
    const Segment& segment = segments_[e];
    const Ends near{is_near(segment), is_near(segments_[static_cast<size_t>(segment.next)])};
    const std::span<Root> found(roots.data(), static_cast<size_t>(segment.curve.degree()));
    segment.curve.roots(z, found);
    for (Root& root : found) {
      const Complex slope = segment.curve.derivative(root);
      const Complex log(0.5 * std::log(std::norm(root.q) / std::norm(root.s)), angle_of(root));
      turns += log.imag();
      // If the boundary is smooth at a vertex, the extension of the neighboring segment is as near
      // as the segment itself. Beyond the ends of a segment, the distance is therefore measured to
      // the end.
      const double beyond = std::max({0.0, -root.s.real(), -root.q.real()});
      const double distance = (root.s.imag() * root.s.imag() + beyond * beyond) * std::norm(slope);
      if (beyond <= 0.1 && distance < nearest) {
        nearest = distance;
        across = &segment;
        crossed = root;
      }
      if (!segment.is_moved) continue;
      const ValueAndSlope part = integral(segment, root, log, near);
      sum.f += part.f;
      sum.df += times(part.df, inverse(slope));
    }
  }
  const Complex factor = inverse(2 * kPi * kI);
  sum = {times(factor, sum.f), times(factor, sum.df)};
  if (turns > kPi || !across || !across->is_moved) return sum;
  // Outside the cage, add the jump across the segment, which is d itself.
  Complex d = 0, slope = 0;
  const Complex v = crossed.s - crossed.q;
  for (size_t k = across->powers.size(); k-- > 0;) {
    slope = times(slope, v) + d;
    d = times(d, v) + across->powers[k];
  }
  sum.f += d;
  sum.df += times(2.0 * slope, inverse(across->curve.derivative(crossed)));
  return sum;
}

}  // namespace holomorph
