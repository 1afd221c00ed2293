// Three expansions of the same polynomial. The expansion about the middle is balanced over the
// segment and is used to find the roots. The expansions about the ends refine the roots near each
// end.
#include "core/geometry/segment.h"

#include <algorithm>
#include <limits>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Powers of t about the curve's start: binomial(n, k) times the k-th forward difference.
Points powers_of(Points differences) {
  const size_t n = differences.size() - 1;
  Points powers;
  double binomial = 1;
  for (size_t k = 0; k <= n; ++k) {
    powers.push_back(binomial * differences[0]);
    for (size_t i = 0; i + 1 < differences.size(); ++i)
      differences[i] = differences[i + 1] - differences[i];
    differences.pop_back();
    binomial *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return powers;
}

struct ValueAndSlope {
  Complex value, slope;
};

/// The polynomial minus z, and its derivative, by Horner's scheme.
ValueAndSlope horner(const Points& powers, const FinePoint& z, Complex x) {
  ValueAndSlope at{powers.back(), 0};
  for (size_t k = powers.size() - 1; k-- > 0;) {
    at.slope = times(at.slope, x) + at.value;
    at.value = times(at.value, x) + (k == 0 ? powers[0] - z : powers[k]);
  }
  return at;
}

}  // namespace

Points powers_about_start(std::span<const Complex> controls) {
  return powers_of(Points(controls.begin(), controls.end()));
}

Points powers_about_middle(std::span<const Complex> controls) {
  return powers_of(split(controls, 0.5).after);
}

SegmentPolynomial::SegmentPolynomial(std::span<const Complex> controls) {
  check(!controls.empty() && controls.size() <= kHighestDegree + 1, "segment: degree 0 to 8");
  for (const Complex& z : controls) magnitude_ = std::max(magnitude_, std::abs(z));
  box_ = box_of(controls);
  Points backwards(controls.rbegin(), controls.rend());
  middle_ = powers_about_middle(controls);
  start_ = powers_of(Points(controls.begin(), controls.end()));
  end_ = powers_of(std::move(backwards));
  // A leading coefficient is ignored if it may be only rounding error of the control points,
  // amplified by the differences.
  const auto rounding = [&] {
    const double n = static_cast<double>(controls.size()) - 1, k = static_cast<double>(degree());
    double binomial = 1;
    for (double i = 1; i <= k; ++i) binomial *= (n - k + i) / i;
    return 4 * kEpsilon * magnitude_ * binomial * std::exp2(k);
  };
  while (degree() > 0 && std::abs(middle_.back()) <= rounding()) {
    middle_.pop_back();
    start_.pop_back();
    end_.pop_back();
  }
  if (!is_straight()) return;
  start_[1] = controls.back() - controls.front();  // exact, even if control points are rounded
  end_[1] = -start_[1];
}

void SegmentPolynomial::refine(const FinePoint& z, Root& root) const {
  const bool from_start = std::norm(root.s) <= std::norm(root.q);
  Complex& x = from_start ? root.s : root.q;
  const Points& powers = from_start ? start_ : end_;
  if (std::norm(x) > 1) return;
  // Close to the end, all digits of x may be wrong, but no other root is this close.
  constexpr double kAtEnd = 1e-10;
  for (int step = 0; step < 3; ++step) {
    const ValueAndSlope at = horner(powers, z, x);
    const Complex move = quotient(at.value, at.slope);
    if (!is_finite(move)) break;
    if (std::norm(move) > 1e-4 * std::norm(x) && std::norm(move) > kAtEnd * kAtEnd)
      break;  // nearly a double root
    x -= move;
  }
  (from_start ? root.q : root.s) = 1.0 - x;
}

void SegmentPolynomial::roots(const FinePoint& z, std::span<Root> out,
                              std::span<const Root> near) const {
  const int n = degree();
  if (n == 0) return;
  if (n == 1) {
    const Complex unit = quotient(1.0, start_[1]);
    out[0] = {times(-(start_[0] - z), unit), times(end_[0] - z, unit)};
    return;
  }
  std::array<Complex, kHighestDegree> v;
  const bool warm = static_cast<int>(near.size()) == n;
  const Complex center = -quotient(middle_[n - 1], static_cast<double>(n) * middle_[n]);
  const double radius =
      std::pow(std::abs(quotient(horner(middle_, z, center).value, middle_[n])), 1.0 / n) + 1e-3;
  for (int r = 0; r < n; ++r)
    v[r] =
        warm ? near[r].s - near[r].q : center + std::polar(radius, 2 * kPi * (r + 0.25) / n + 0.4);
  for (int step = 0; step < 80; ++step) {
    bool done = true;
    for (int r = 0; r < n; ++r) {
      const ValueAndSlope at = horner(middle_, z, v[r]);
      if (at.value == Complex(0)) continue;
      Complex pull = quotient(at.slope, at.value);
      for (int other = 0; other < n; ++other)
        if (other != r && v[other] != v[r]) pull -= quotient(1.0, v[r] - v[other]);
      const Complex move = quotient(1.0, pull);
      if (!is_finite(move)) continue;
      v[r] -= move;
      done = done && std::norm(move) <= 1e-24 * (1 + std::norm(v[r]));
    }
    if (done) break;
  }
  for (int r = 0; r < n; ++r) {
    out[r] = {0.5 * (1.0 + v[r]), 0.5 * (1.0 - v[r])};
    refine(z, out[r]);
  }
}

void SegmentPolynomial::taylor(const Root& at, std::span<Complex> out) const {
  const bool from_start = std::norm(at.s) <= std::norm(at.q);
  Points work = from_start ? start_ : end_;
  const Complex x = from_start ? at.s : at.q;
  // Repeated synthetic division shifts the expansion to x.
  for (size_t j = 0; j < work.size(); ++j)
    for (size_t k = work.size() - 1; k-- > j;) work[k] += times(work[k + 1], x);
  for (size_t j = 0; j < out.size(); ++j) {
    out[j] = j < work.size() ? work[j] : Complex(0);
    if (!from_start && j % 2 == 1) out[j] = -out[j];  // q runs backward
  }
}

FinePoint SegmentPolynomial::fine_at(const Root& parameter) const {
  const bool from_start = std::norm(parameter.s) <= std::norm(parameter.q);
  const Points& powers = from_start ? start_ : end_;
  const Complex x = from_start ? parameter.s : parameter.q;
  Complex offset = 0;
  for (size_t k = powers.size() - 1; k > 0; --k) offset = times(offset + powers[k], x);
  return {powers[0], offset};
}

Complex SegmentPolynomial::derivative(const Root& at) const {
  const bool from_start = std::norm(at.s) <= std::norm(at.q);
  const ValueAndSlope value =
      horner(from_start ? start_ : end_, Complex(0), from_start ? at.s : at.q);
  return from_start ? value.slope : -value.slope;
}

}  // namespace holomorph
