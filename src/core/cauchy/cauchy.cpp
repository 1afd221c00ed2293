// Stable evaluation of the Bernstein moments of one segment,
// M_n[m] = integral_0^1 B_m^N(t) / (t - s)^(n+1) dt.
//
// Near an edge (small ellipse |s| + |q|), degree raising from one logarithm is stable. Far from the
// edge, the same sums suffer from cancellation, but Gauss-Legendre quadrature converges fast.
// Together they are accurate to 1e-14.
#include "core/cauchy/cauchy.h"

#include <algorithm>
#include <array>

#include "core/arithmetic.h"
#include "core/cauchy/quadrature.h"
#include "core/error.h"

namespace holomorph {
namespace {

constexpr std::array<int, 12> kRuleSizes{4, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};

/// A rule with at least `size` nodes, chosen from a few sizes. The largest rule has 64 nodes.
const GaussRule& gauss_rule_of_at_least(int size) {
  for (const int rule : kRuleSizes)
    if (rule >= size) return gauss_rule(rule);
  return gauss_rule(kRuleSizes.back());
}

/// One root of c(t) = z and the logarithm of q / -s, the integral of 1 / (t - s).
struct SegmentView {
  Complex s, q, log;
};

SegmentView view_of(const Root& root, bool on_edge) {
  const Complex s = on_edge ? root.s.real() : root.s, q = on_edge ? root.q.real() : root.q;
  return {s, q, {0.5 * std::log(std::norm(q) / std::norm(s)), on_edge ? kPi : angle_of(root)}};
}

/// The moments of all orders up to `order`, by degree raising: row n holds M_n.
MatrixXc moments_near(const SegmentView& view, int degree, int order) {
  MatrixXc moments = MatrixXc::Zero(order + 1, degree + 1);
  moments(0, 0) = view.log;
  Complex start_power = 1, end_power = 1;
  for (int n = 1; n <= order; ++n) {
    start_power = times(start_power, inverse(-view.s));
    end_power = times(end_power, inverse(view.q));
    moments(n, 0) = (start_power - end_power) / static_cast<double>(n);
  }
  MatrixXc raised(order + 1, degree + 1);
  for (int d = 1; d <= degree; ++d) {
    for (int n = 0; n <= order; ++n)
      for (int m = 0; m <= d; ++m) {
        Complex value = 0;
        if (m < d) value += times(view.q, moments(n, m));
        if (m > 0) value += times(view.s, moments(n, m - 1));
        if (n == 0) {
          if (m == 0) value -= 1.0 / d;
          if (m == d) value += 1.0 / d;
        } else {
          if (m > 0) value += moments(n - 1, m - 1);
          if (m < d) value -= moments(n - 1, m);
        }
        raised(n, m) = value;
      }
    moments.leftCols(d + 1) = raised.leftCols(d + 1);
  }
  return moments;
}

/// The number of Gauss-Legendre nodes that integrate a polynomial of the given degree, divided by
/// powers of (t - s) up to `order`, if s lies on the ellipse |s| + |q| = `ellipse`.
int nodes_for(double ellipse, int degree, int order) {
  const double rho = ellipse + std::sqrt(ellipse * ellipse - 1);
  return static_cast<int>(std::ceil(((37 + 2 * order) / std::log(rho) + degree) / 2)) + 1;
}

/// Values of all Bernstein polynomials of the given degree at t.
void bernstein(int degree, double t, std::vector<double>& values) {
  values.assign(degree + 1, 0);
  values[0] = 1;
  for (int d = 1; d <= degree; ++d)
    for (int m = d; m >= 0; --m)
      values[m] = (m < d ? (1 - t) * values[m] : 0.0) + (m > 0 ? t * values[m - 1] : 0.0);
}

MatrixXc moments_far(const SegmentView& view, int degree, int order, int nodes) {
  const GaussRule& rule = gauss_rule_of_at_least(nodes);
  MatrixXc moments = MatrixXc::Zero(order + 1, degree + 1);
  std::vector<double> basis;
  for (size_t g = 0; g < rule.nodes.size(); ++g) {
    bernstein(degree, rule.nodes[g], basis);
    const Complex kernel = inverse(rule.nodes[g] - view.s);
    Complex power = rule.weights[g] * kernel;
    for (int n = 0; n <= order; ++n) {
      for (int m = 0; m <= degree; ++m) moments(n, m) += basis[m] * power;
      power = times(power, kernel);
    }
  }
  return moments;
}

double near_limit(int degree) {
  return degree == 1 ? 2.0 : degree <= 3 ? 1.6 : degree <= 6 ? 1.35 : 1.25;
}

/// Row n: M_n[m] = integral of B_m / (t - s)^(n + 1), which is also the n-th Taylor coefficient of
/// M_0 as a function of s.
MatrixXc moments_at(const SegmentView& view, int degree, int order) {
  const double ellipse = std::abs(view.s) + std::abs(view.q);
  return ellipse <= near_limit(degree)
             ? moments_near(view, degree, order)
             : moments_far(view, degree, order, nodes_for(ellipse, degree, order));
}

/// Reversion of series. `curve` holds the Taylor coefficients of a curve. Returns the coefficients
/// 1..order of the branch t(z + h) - t(z) of its inverse, in powers of h.
std::vector<Complex> reversion(const std::vector<Complex>& curve, int order) {
  std::vector<Complex> branch(order + 1);
  const Complex unit = inverse(curve[1]);
  for (int k = 1; k <= order; ++k) {
    // [h^k] of the sum over j >= 2 of curve_j (branch)^j, which depends on branch only up to k - 1.
    Complex rest = 0;
    std::vector<Complex> power = branch;  // branch^j
    for (int j = 2; j <= k; ++j) {
      std::vector<Complex> next(order + 1);
      for (int x = j - 1; x < k; ++x)
        for (int y = 1; x + y <= k; ++y) next[x + y] += times(power[x], branch[y]);
      power = std::move(next);
      rest += times(curve[j], power[k]);
    }
    branch[k] = times((k == 1 ? Complex(1) : Complex(0)) - rest, unit);
  }
  return branch;
}

/// Adds the coefficient of h^order of M_0(t(z + h)), along the branch of one root.
void add_branch(const SegmentPolynomial& segment, const Root& root, const MatrixXc& moments,
                VectorXc& sum) {
  const int order = static_cast<int>(moments.rows()) - 1;
  if (order == 0) {
    sum += moments.row(0).transpose();
    return;
  }
  std::vector<Complex> curve(order + 1);
  segment.taylor(root, curve);
  const std::vector<Complex> branch = reversion(curve, order);
  std::vector<Complex> power = branch;
  for (int n = 1; n <= order; ++n) {
    for (Index m = 0; m < sum.size(); ++m) sum[m] += times(moments(n, m), power[order]);
    std::vector<Complex> next(order + 1);
    for (int x = n; x < order; ++x)
      for (int y = 1; x + y <= order; ++y) next[x + y] += times(power[x], branch[y]);
    power = std::move(next);
  }
}

/// Adds the integral of B_m c' / (c - z)^(order + 1) over [from, to] by quadrature. The interval is
/// halved until every root is far from each piece. Returns false if a root is on the curve.
bool add_quadrature(const SegmentPolynomial& segment, std::span<const Root> roots, Complex z,
                    double from, double to, int order, VectorXc& sum) {
  constexpr double kFar = 1.3, kShortest = 1.0 / 4096;
  const double length = to - from;
  double ellipse = 1e300;
  for (const Root& root : roots)
    ellipse = std::min(ellipse, (std::abs(root.s - from) + std::abs(to - root.s)) / length);
  if (ellipse < kFar) {
    const double middle = 0.5 * (from + to);
    return length > kShortest && add_quadrature(segment, roots, z, from, middle, order, sum) &&
           add_quadrature(segment, roots, z, middle, to, order, sum);
  }
  const int degree = static_cast<int>(sum.size()) - 1;
  const GaussRule& rule =
      gauss_rule_of_at_least(nodes_for(ellipse, degree + segment.degree() * (order + 1), order));
  std::vector<double> basis;
  std::array<Complex, 2> curve;
  for (size_t g = 0; g < rule.nodes.size(); ++g) {
    const double t = from + length * rule.nodes[g];
    bernstein(degree, t, basis);
    segment.taylor({t, 1 - t}, curve);
    const Complex kernel = inverse(curve[0] - z);
    Complex value = length * rule.weights[g] * times(curve[1], kernel);
    for (int n = 0; n < order; ++n) value = times(value, kernel);
    for (int m = 0; m <= degree; ++m) sum[m] += basis[m] * value;
  }
  return true;
}

/// Whether two roots are so close to each other that quadrature is more accurate. A double root is
/// accurate to only half the digits, and the derivatives of two close roots cancel each other.
bool has_close_roots(std::span<const Root> roots, int order) {
  const double apart = order == 0 ? 1e-3 : 0.05;
  for (size_t i = 0; i < roots.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (std::norm(roots[i].s - roots[j].s) < apart * apart) return true;
  return false;
}

/// order! / (2 pi i).
Complex cauchy_factor(int order) {
  Complex factor = inverse(2 * kPi * kI);
  for (int n = 2; n <= order; ++n) factor *= n;
  return factor;
}

/// Removes the poles that the first and the last control point of a segment have at its ends.
///
/// Integration by parts turns the integral of B / (t - s)^2 into the pole plus the integral of
/// B' / (t - s).
void drop_poles(const SegmentView& view, Ends ends, MatrixXc& moments) {
  const int order = static_cast<int>(moments.rows()) - 1,
            degree = static_cast<int>(moments.cols()) - 1;
  if (order == 0 || !(ends.start || ends.end)) return;
  const MatrixXc lower = moments_at(view, degree - 1, order - 1);
  for (int n = 1; n <= order; ++n) {
    const double factor = static_cast<double>(degree) / n;
    if (ends.start) moments(n, 0) = -factor * lower(n - 1, 0);
    if (ends.end) moments(n, degree) = factor * lower(n - 1, degree - 1);
  }
}

/// The pole at an end of the segment, given the offset from z to this end.
Complex pole_at(Complex from_end, int order) {
  Complex power = 1;
  for (int n = 0; n < order; ++n) power = times(power, inverse(from_end));
  return power / static_cast<double>(order);
}

}  // namespace

double angle_of(const Root& root) {
  const double left = std::norm(root.s) <= std::norm(root.q) ? root.s.imag() : -root.q.imag();
  return std::atan2(left, dot(-root.s, root.q));
}

VectorXc segment_coordinates(const SegmentPolynomial& segment, int degree, const FinePoint& z,
                             int order, const Contact* own, Ends without_poles) {
  std::vector<Root> roots(static_cast<size_t>(segment.degree()));
  segment.roots(z, roots);
  auto on = roots.end();
  if (own) {  // the nearest root is exactly this parameter
    on = std::min_element(roots.begin(), roots.end(), [&](const Root& x, const Root& y) {
      return std::norm(x.s - own->s) < std::norm(y.s - own->s);
    });
    *on = {own->s, own->q};
  }
  VectorXc sum = VectorXc::Zero(degree + 1);
  if (!own && has_close_roots(roots, order) &&
      add_quadrature(segment, roots, z.plain(), 0, 1, order, sum)) {
    if (order > 0 && without_poles.start) sum[0] -= pole_at(segment.start() - z, order);
    if (order > 0 && without_poles.end) sum[degree] += pole_at(segment.end() - z, order);
    return cauchy_factor(order) * sum;
  }
  sum.setZero();
  for (auto root = roots.begin(); root != roots.end(); ++root) {
    const SegmentView view = view_of(*root, root == on);
    MatrixXc moments = moments_at(view, degree, order);
    drop_poles(view, without_poles, moments);
    add_branch(segment, *root, moments, sum);
  }
  return cauchy_factor(order) * sum;
}

VectorXc edge_coordinates(Complex a, Complex b, int degree, Complex z, int order, bool on_edge) {
  const std::array<Complex, 2> ends{a, b};
  const SegmentPolynomial segment(ends);
  if (!on_edge) return segment_coordinates(segment, degree, z, order);
  Root root;
  segment.roots(z, std::span(&root, 1));
  const Contact own{0, root.s.real(), root.q.real(), z};
  return segment_coordinates(segment, degree, z, order, &own);
}

namespace {

double harmonic_number(int n) {
  double sum = 0;
  for (int k = 1; k <= n; ++k) sum += 1.0 / k;
  return sum;
}

/// The sum over the roots of a segment for z at one of its ends, without the root at that end.
VectorXc other_roots(const SegmentPolynomial& segment, int degree, bool at_start) {
  VectorXc sum = VectorXc::Zero(degree + 1);
  if (segment.is_straight()) return sum;
  std::vector<Root> roots(segment.degree());
  segment.roots(segment.at(at_start ? Root{0, 1} : Root{1, 0}), roots);
  const auto end = std::min_element(roots.begin(), roots.end(), [&](const Root& x, const Root& y) {
    return std::norm(at_start ? x.s : x.q) < std::norm(at_start ? y.s : y.q);
  });
  roots.erase(end);
  for (const Root& root : roots)
    sum += moments_at(view_of(root, false), degree, 0).row(0).transpose();
  return cauchy_factor(0) * sum;
}

}  // namespace

// The logarithms of the two segments cancel, except for the ratio of their speeds.
VertexLimit vertex_limit(const SegmentPolynomial& before, int degree_before,
                         const SegmentPolynomial& own, int degree) {
  const Complex turn = 2 * kPi * kI;
  VertexLimit limit{other_roots(before, degree_before, false), other_roots(own, degree, true)};
  for (int m = 0; m < degree_before; ++m)
    limit.before[m] -= 1.0 / (turn * static_cast<double>(degree_before - m));
  for (int m = 1; m <= degree; ++m) limit.own[m] += 1.0 / (turn * static_cast<double>(m));
  const Complex in = -before.derivative({1, 0}), out = own.derivative({0, 1});
  limit.own[0] +=
      (Complex(0.5 * std::log(std::norm(out) / std::norm(in)), 2 * kPi - inner_angle(out, in)) +
       harmonic_number(degree_before) - harmonic_number(degree)) /
      turn;
  return limit;
}

std::vector<Index> independent_controls(const Cage& cage) {
  const Loops loops = cage.loops();
  std::vector<Index> dependent;
  for (Index l = 1; l < loops.count(); ++l)
    for (const Index vertex : {loops.first(l), loops.first(l) + loops.length(l) / 2})
      dependent.push_back(cage.control_offset(vertex));
  std::vector<Index> kept;
  for (Index c = 0; c < cage.control_count(); ++c)
    if (!std::ranges::binary_search(dependent, c)) kept.push_back(c);
  return kept;
}

}  // namespace holomorph
