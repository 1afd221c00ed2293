// Stable evaluation of Bernstein moments M_n[m] = integral_0^1 B_m^N(t) / (t - s)^(n+1) dt.
//
// Near an edge (small ellipse |s| + |q|) degree raising from one logarithm is stable; far from it
// the same sums cancel and Gauss-Legendre quadrature converges fast. Together: 1e-14.
#include "core/cauchy.h"

#include <array>
#include <limits>

#include "core/error.h"

namespace holomorph {
namespace {

constexpr std::array<int, 12> kRuleSizes{4, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};

/// Nodes on [0, 1] and weights of a Gauss-Legendre rule.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// Newton's method on the Legendre recurrence in extended precision.
GaussRule gauss_rule(int size) {
  GaussRule rule{std::vector<double>(size), std::vector<double>(size)};
  for (int i = 0; i < size; ++i) {
    long double x = std::cos(3.14159265358979323846264338L * (i + 0.75L) / (size + 0.5L));
    long double slope = 0;
    for (int step = 0; step < 100; ++step) {
      long double p = 1, before = 0;
      for (int k = 1; k <= size; ++k) {
        const long double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = size * (x * p - before) / (x * x - 1);
      const long double move = p / slope;
      x -= move;
      if (std::abs(move) < 1e-19L) break;
    }
    rule.nodes[i] = static_cast<double>(0.5L * (1 - x));
    rule.weights[i] = static_cast<double>(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const GaussRule& gauss_rule_of_at_least(int size) {
  static const auto rules = [] {
    std::array<GaussRule, kRuleSizes.size()> all;
    for (size_t i = 0; i < all.size(); ++i) all[i] = gauss_rule(kRuleSizes[i]);
    return all;
  }();
  for (size_t i = 0; i < rules.size(); ++i)
    if (kRuleSizes[i] >= size) return rules[i];
  return rules.back();
}

/// z seen from one edge: s = 0 at its start, q = 0 at its end, L the logarithm of their ratio.
struct EdgeView {
  Complex s, q, log;
};

/// Products written out: std::complex's operators guard against infinities and lose speed for it.
Complex times(Complex x, Complex y) {
  return {x.real() * y.real() - x.imag() * y.imag(), x.real() * y.imag() + x.imag() * y.real()};
}
Complex inverse(Complex x) {
  return std::conj(x) / std::norm(x);
}

EdgeView edge_view(Complex a, Complex b, Complex z, bool on_edge) {
  const Complex to_start = a - z, to_end = b - z, unit = inverse(b - a);
  EdgeView view{-times(to_start, unit), times(to_end, unit), {}};
  const double rounding = 4 * std::numeric_limits<double>::epsilon() *
                          (std::abs(a) + std::abs(b) + std::abs(z)) / std::abs(b - a);
  on_edge =
      on_edge || (std::abs(view.s.imag()) <= rounding && view.s.real() > 0 && view.s.real() < 1);
  if (on_edge) {
    view.s = view.s.real();
    view.q = view.q.real();
  }
  view.log = {0.5 * std::log(std::norm(to_end) / std::norm(to_start)),
              on_edge ? kPi : std::atan2(cross(to_start, to_end), dot(to_start, to_end))};
  return view;
}

/// Degree raising of the moments, all orders up to `order` at once.
VectorXc moments_near(const EdgeView& view, int degree, int order) {
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
  return moments.row(order).transpose();
}

VectorXc moments_far(const EdgeView& view, int degree, int order, double rho) {
  const int wanted =
      static_cast<int>(std::ceil(((37 + 2 * order) / std::log(rho) + degree) / 2)) + 1;
  const GaussRule& rule = gauss_rule_of_at_least(wanted);
  VectorXc moments = VectorXc::Zero(degree + 1);
  std::vector<double> basis(degree + 1);
  for (size_t g = 0; g < rule.nodes.size(); ++g) {
    const double t = rule.nodes[g];
    basis[0] = 1;
    for (int d = 1; d <= degree; ++d)
      for (int m = d; m >= 0; --m)
        basis[m] = (m < d ? (1 - t) * basis[m] : 0.0) + (m > 0 ? t * basis[m - 1] : 0.0);
    const Complex kernel = inverse(t - view.s);
    Complex power = rule.weights[g] * kernel;
    for (int n = 0; n < order; ++n) power = times(power, kernel);
    for (int m = 0; m <= degree; ++m) moments[m] += basis[m] * power;
  }
  return moments;
}

double near_limit(int degree) {
  return degree == 1 ? 2.0 : degree <= 3 ? 1.6 : degree <= 6 ? 1.35 : 1.25;
}

double harmonic_number(int n) {
  double sum = 0;
  for (int k = 1; k <= n; ++k) sum += 1.0 / k;
  return sum;
}

/// One row of coordinates for a counter-clockwise cage. `edge` is the segment that z is known to
/// lie on, or -1; z may also be a vertex.
class RowBuilder {
 public:
  RowBuilder(const Cage& cage, int order) : cage_(cage), order_(order) {
    for (Index e = 0; e < cage.size(); ++e) offsets_.push_back(cage.control_offset(e));
  }

  VectorXc row(Complex z, Index edge) const {
    const Index n = cage_.size();
    VectorXc row = VectorXc::Zero(cage_.control_count());
    for (Index v = 0; v < n; ++v)
      if (cage_.vertex(v) == z) return vertex_row(v, row);
    for (Index e = 0; e < n; ++e) add_edge(row, e, z, e == edge);
    if (order_ == 2) set_second_derivatives(row, z);
    return row;
  }

 private:
  Index column(Index edge, int m) const {
    return m < cage_.degree(edge) ? offsets_[edge] + m : offsets_[(edge + 1) % cage_.size()];
  }

  void add_edge(VectorXc& row, Index edge, Complex z, bool on_edge) const {
    const VectorXc values = edge_coordinates(cage_.vertex(edge), cage_.vertex(edge + 1),
                                             cage_.degree(edge), z, order_, on_edge);
    for (int m = 0; m <= cage_.degree(edge); ++m) row[column(edge, m)] += values[m];
  }

  /// The limit at a vertex: the logarithms of the two edges cancel up to the ratio of their
  /// lengths.
  VectorXc vertex_row(Index vertex, VectorXc& row) const {
    const Index n = cage_.size(), before = (vertex + n - 1) % n;
    if (order_ > 0) {
      row.setConstant(Complex(std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::quiet_NaN()));
      return row;
    }
    const Complex z = cage_.vertex(vertex);
    for (Index e = 0; e < n; ++e)
      if (e != vertex && e != before) add_edge(row, e, z, false);
    const Complex turn = 2 * kPi * kI;
    const int degree_before = cage_.degree(before), degree = cage_.degree(vertex);
    for (int m = 0; m < degree_before; ++m)
      row[column(before, m)] -= 1.0 / (turn * static_cast<double>(degree_before - m));
    for (int m = 1; m <= degree; ++m)
      row[column(vertex, m)] += 1.0 / (turn * static_cast<double>(m));
    row[column(vertex, 0)] += vertex_limit(cage_.vertex(vertex - 1), z, cage_.vertex(vertex + 1)) +
                              (harmonic_number(degree_before) - harmonic_number(degree)) / turn;
    return row;
  }

  /// Between two straight edges the second derivative is rational: no cancellation at all.
  void set_second_derivatives(VectorXc& row, Complex z) const {
    const Index n = cage_.size();
    for (Index v = 0; v < n; ++v) {
      if (cage_.degree(v) != 1 || cage_.degree((v + n - 1) % n) != 1) continue;
      const Complex before = cage_.vertex(v - 1), after = cage_.vertex(v + 1);
      const Complex product = times(times(before - z, cage_.vertex(v) - z), after - z);
      row[offsets_[v]] = times(after - before, inverse(2 * kPi * times(kI, product)));
    }
  }

  const Cage& cage_;
  int order_;
  std::vector<Index> offsets_;
};

/// Column of the reversed cage that holds column c of the cage.
std::vector<Index> reversal(const Cage& cage) {
  Cage tagged = cage;
  Index c = 0;
  for (Points& segment : tagged.segments)
    for (Complex& z : segment) z = static_cast<double>(c++);
  const VectorXc order = controls_of(reversed(tagged));
  std::vector<Index> column(c);
  for (Index i = 0; i < c; ++i) column[static_cast<Index>(order[i].real())] = i;
  return column;
}

template <class RowOf>
MatrixXc rows(const Cage& cage, Index count, int order, RowOf row_of) {
  if (order < 0) throw Error(ErrorKind::bad_input, "the order of a derivative cannot be negative");
  if (!is_straight(cage))
    throw Error(ErrorKind::bad_input, "Cauchy coordinates need a cage whose rest is straight");
  MatrixXc result(count, cage.control_count());
  const bool clockwise = signed_area(vertices_of(cage)) < 0;
  const Cage turned = clockwise ? reversed(cage) : Cage{};
  const Cage& oriented = clockwise ? turned : cage;
  const RowBuilder builder(oriented, order);
  for (Index i = 0; i < count; ++i) result.row(i) = row_of(builder, i, clockwise).transpose();
  if (!clockwise) return result;
  MatrixXc unturned(result.rows(), result.cols());
  const std::vector<Index> column = reversal(cage);
  for (Index c = 0; c < result.cols(); ++c) unturned.col(c) = result.col(column[c]);
  return unturned;
}

}  // namespace

Complex position_of(const Cage& cage, BoundaryPoint point) {
  return (1 - point.t) * cage.vertex(point.segment) + point.t * cage.vertex(point.segment + 1);
}

VectorXc edge_coordinates(Complex a, Complex b, int degree, Complex z, int order, bool on_edge) {
  const EdgeView view = edge_view(a, b, z, on_edge);
  const double ellipse = std::abs(view.s) + std::abs(view.q);
  VectorXc moments =
      ellipse <= near_limit(degree)
          ? moments_near(view, degree, order)
          : moments_far(view, degree, order, ellipse + std::sqrt(ellipse * ellipse - 1));
  Complex factor = inverse(2 * kPi * kI);
  for (int n = 1; n <= order; ++n) factor = times(factor, static_cast<double>(n) * inverse(b - a));
  for (Complex& moment : moments) moment = times(moment, factor);
  return moments;
}

Complex vertex_limit(Complex before, Complex vertex, Complex after) {
  const Complex out = after - vertex, in = before - vertex;
  double angle = std::atan2(cross(out, in), dot(out, in));
  if (angle <= 0) angle += 2 * kPi;
  return Complex(0.5 * std::log(std::norm(out) / std::norm(in)), 2 * kPi - angle) / (2 * kPi * kI);
}

std::array<Complex, 2> linear_edge_coordinates(Complex a, Complex b, Complex z, int order) {
  const EdgeView view = edge_view(a, b, z, false);
  if (std::abs(view.s) + std::abs(view.q) > near_limit(1)) {
    const VectorXc values = edge_coordinates(a, b, 1, z, order);
    return {values[0], values[1]};
  }
  const Complex factor = inverse(2 * kPi * kI);
  if (order == 0)
    return {times(factor, times(view.q, view.log) - 1.0),
            times(factor, times(view.s, view.log) + 1.0)};
  const Complex pole = inverse(-view.s) - inverse(view.q), slope = times(factor, inverse(b - a));
  return {times(slope, times(view.q, pole) - view.log),
          times(slope, times(view.s, pole) + view.log)};
}

MatrixXc cauchy_coordinates(const Cage& cage, std::span<const Complex> points, int order) {
  return rows(cage, static_cast<Index>(points.size()), order,
              [&](const RowBuilder& builder, Index i, bool) { return builder.row(points[i], -1); });
}

MatrixXc cauchy_coordinates(const Cage& cage, std::span<const BoundaryPoint> points, int order) {
  return rows(cage, static_cast<Index>(points.size()), order,
              [&](const RowBuilder& builder, Index i, bool clockwise) {
                const Index segment = points[i].segment;
                const Complex z =
                    points[i].t == 0 ? cage.vertex(segment) : position_of(cage, points[i]);
                return builder.row(z, clockwise ? cage.size() - 1 - segment : segment);
              });
}

}  // namespace holomorph
