// Bezier segments by de Casteljau's algorithm, and polylines by orientation tests in extended
// precision. The 11 additional bits give correct signs for coordinates up to millions of pixels.
#include "core/geometry/curve.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace holomorph {

Complex bezier_point(std::span<const Complex> controls, double t) {
  Points work(controls.begin(), controls.end());
  for (size_t level = work.size() - 1; level > 0; --level)
    for (size_t i = 0; i < level; ++i) work[i] = (1 - t) * work[i] + t * work[i + 1];
  return work[0];
}

SplitCurve split(std::span<const Complex> controls, double t) {
  const size_t n = controls.size();
  Points work(controls.begin(), controls.end());
  SplitCurve halves{Points(n), Points(n)};
  for (size_t level = 0; level < n; ++level) {
    halves.before[level] = work[0];
    halves.after[n - 1 - level] = work[n - 1 - level];
    for (size_t i = 0; i + 1 < n - level; ++i) work[i] = (1 - t) * work[i] + t * work[i + 1];
  }
  return halves;
}

Points elevated(std::span<const Complex> controls, int degree) {
  Points curve(controls.begin(), controls.end());
  if (static_cast<int>(curve.size()) - 1 > degree)
    throw Error(ErrorKind::bad_input, "the degree of a curve cannot be raised to a lower degree");
  while (static_cast<int>(curve.size()) - 1 < degree) {
    const size_t n = curve.size();
    Points raised(n + 1);
    raised[0] = curve[0];
    raised[n] = curve[n - 1];
    for (size_t i = 1; i < n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(n);
      raised[i] = share * curve[i - 1] + (1 - share) * curve[i];
    }
    curve = std::move(raised);
  }
  return curve;
}

namespace {

double bernstein(int degree, int m, double t) {
  double value = 1.0;
  for (int i = 1; i <= m; ++i) value *= t * (degree - m + i) / i;
  return value * std::pow(1 - t, degree - m);
}

}  // namespace

Points fitted(std::span<const Complex> samples, std::span<const double> parameters, int degree) {
  check(samples.size() == parameters.size() && samples.size() >= 2,
        "fitted: one parameter per sample, two or more samples");
  Points curve(degree + 1);
  curve.front() = samples.front();
  curve.back() = samples.back();
  const Index inner = degree - 1, rows = static_cast<Index>(samples.size());
  if (inner <= 0) return curve;
  Eigen::MatrixXd basis(rows, inner);
  Eigen::MatrixX2d target(rows, 2);
  for (Index i = 0; i < rows; ++i) {
    const double t = parameters[i];
    for (Index m = 1; m <= inner; ++m) basis(i, m - 1) = bernstein(degree, static_cast<int>(m), t);
    const Complex rest = samples[i] - bernstein(degree, 0, t) * curve.front() -
                         bernstein(degree, degree, t) * curve.back();
    target.row(i) << rest.real(), rest.imag();
  }
  const Eigen::MatrixX2d solution = basis.colPivHouseholderQr().solve(target);
  for (Index m = 0; m < inner; ++m) curve[m + 1] = {solution(m, 0), solution(m, 1)};
  return curve;
}

double inner_angle(Complex out, Complex in) {
  const double angle = std::atan2(cross(out, in), dot(out, in));
  return angle > 0 ? angle : angle + 2 * kPi;
}

Complex interior_bisector(Complex out, Complex in) {
  return std::polar(1.0, std::arg(out) + 0.5 * inner_angle(out, in));
}

double signed_area(std::span<const Complex> polygon) {
  double twice = 0.0;
  const Complex origin = polygon.empty() ? Complex{} : polygon[0];
  for (size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i] - origin, polygon[(i + 1) % polygon.size()] - origin);
  return 0.5 * twice;
}

double perimeter(std::span<const Complex> polygon) {
  double length = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i)
    length += std::abs(polygon[(i + 1) % polygon.size()] - polygon[i]);
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

int winding_number(std::span<const Complex> polygon, Complex z) {
  int winding = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Complex a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a.imag() <= z.imag()) {
      if (b.imag() > z.imag() && orientation(a, b, z) > 0) ++winding;
    } else if (b.imag() <= z.imag() && orientation(a, b, z) < 0) {
      --winding;
    }
  }
  return winding;
}

NearestPoint nearest_on_segment(Complex a, Complex b, Complex z) {
  const double length2 = std::norm(b - a);
  const double t = length2 > 0 ? std::clamp(dot(z - a, b - a) / length2, 0.0, 1.0) : 0.0;
  const Complex point = a + t * (b - a);
  return {0, t, point, std::abs(z - point)};
}

NearestPoint nearest_on_polygon(std::span<const Complex> polygon, Complex z) {
  NearestPoint best;
  best.distance = 1e300;
  for (size_t i = 0; i < polygon.size(); ++i) {
    NearestPoint here = nearest_on_segment(polygon[i], polygon[(i + 1) % polygon.size()], z);
    here.edge = static_cast<Index>(i);
    if (here.distance < best.distance) best = here;
  }
  return best;
}

std::optional<Crossing> self_crossing(std::span<const Complex> polygon) {
  const Index n = static_cast<Index>(polygon.size());
  const auto at = [&](Index i) { return polygon[i % n]; };
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), Index{0});
  const auto left = [&](Index e) { return std::min(at(e).real(), at(e + 1).real()); };
  const auto right = [&](Index e) { return std::max(at(e).real(), at(e + 1).real()); };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return left(a) < left(b); });

  const auto cross_at = [&](Index i, Index j) -> std::optional<Complex> {
    const Complex a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
    // Neighboring edges always share a vertex. They cross only if one folds back onto the other.
    if ((i + 1) % n == j)
      return orientation(a, b, d) == 0 && dot(a - b, d - b) > 0 ? std::optional(b) : std::nullopt;
    if ((j + 1) % n == i)
      return orientation(c, d, b) == 0 && dot(c - d, b - d) > 0 ? std::optional(d) : std::nullopt;
    return common_point(a, b, c, d);
  };

  std::vector<Index> open;
  for (const Index e : order) {
    const double low = std::min(at(e).imag(), at(e + 1).imag());
    const double high = std::max(at(e).imag(), at(e + 1).imag());
    std::erase_if(open, [&](Index other) { return right(other) < left(e); });
    for (const Index other : open) {
      if (std::max(at(other).imag(), at(other + 1).imag()) < low) continue;
      if (std::min(at(other).imag(), at(other + 1).imag()) > high) continue;
      const Index i = std::min(e, other), j = std::max(e, other);
      if (const auto point = cross_at(i, j)) return Crossing{i, j, *point};
    }
    open.push_back(e);
  }
  return {};
}

double turning_number(std::span<const Complex> polygon) {
  Points edges;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Complex edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge != Complex{}) edges.push_back(edge);
  }
  double total = 0.0;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Complex a = edges[i], b = edges[(i + 1) % edges.size()];
    total += std::atan2(cross(a, b), dot(a, b));
  }
  return total / (2 * kPi);
}

}  // namespace holomorph
