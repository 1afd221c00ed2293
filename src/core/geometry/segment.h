// A Bezier segment as a polynomial c(t), and every place where it takes a given value.
//
// Over a segment c'(t) / (c(t) - z) = sum over the roots t_r of c(t) = z of 1 / (t - t_r):
// integrals over a curve become integrals over the unit interval, one for each root.
#pragma once

#include <array>

#include "core/geometry/curve.h"

namespace holomorph {

/// A point as a base, such as a vertex, and an offset from it: differences with what is near the
/// base keep all their digits.
struct FinePoint {
  Complex base, offset;

  FinePoint(Complex z) : base(z) {}
  FinePoint(Complex from, Complex by) : base(from), offset(by) {}
  /// Rounded.
  Complex plain() const { return base + offset; }
};
inline Complex operator-(Complex a, const FinePoint& b) {
  return (a - b.base) - b.offset;
}

/// The curve in powers of t.
Points powers_about_start(std::span<const Complex> controls);
/// The curve in powers of 2 t - 1.
Points powers_about_middle(std::span<const Complex> controls);

/// A root t of c(t) = z as s = t and q = 1 - t, each to its own relative precision: near the
/// segment's ends the small one of the two is what matters.
struct Root {
  Complex s, q;
};

class SegmentPolynomial {
 public:
  /// From the control points, kHighestDegree + 1 at most (a check). A curve whose degree was raised
  /// is known for what it was.
  explicit SegmentPolynomial(std::span<const Complex> controls);

  /// The number of roots: the true degree, 0 for a single point.
  int degree() const { return static_cast<int>(middle_.size()) - 1; }
  /// A straight segment run through at constant speed.
  bool is_straight() const { return degree() == 1; }
  Complex start() const { return start_[0]; }
  Complex end() const { return end_[0]; }
  /// The largest modulus among the control points.
  double magnitude() const { return magnitude_; }
  /// A box around the control points.
  const Box& box() const { return box_; }

  /// Writes the degree() roots of c(t) = z. `near`, when given, are the roots of a nearby z: they
  /// start the iteration. Aberth's method, then Newton's from the nearer end; a double root comes
  /// out to half the digits, as it must. Cost: about 100 ns a root.
  void roots(const FinePoint& z, std::span<Root> out, std::span<const Root> near = {}) const;

  /// c^(j)(t) / j! for j below out.size() at a parameter; 0 above the degree. Cost O(degree^2).
  void taylor(const Root& at, std::span<Complex> out) const;
  /// c(t) and c'(t).
  Complex at(const Root& parameter) const { return fine_at(parameter).plain(); }
  /// c(t) as an offset from the nearer end.
  FinePoint fine_at(const Root& parameter) const;
  Complex derivative(const Root& at) const;

 private:
  void refine(const FinePoint& z, Root& root) const;

  // c in powers of 2t - 1, of s = t and of q = 1 - t.
  Points middle_, start_, end_;
  Box box_;
  double magnitude_ = 0;
};

}  // namespace holomorph
