// De Casteljau's algorithm.
#include "core/geometry/curve.h"

#include <Eigen/QR>
#include <algorithm>

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

}  // namespace holomorph
