// A Bezier segment as a polynomial c(t), and all the parameters where it takes a given value.
//
// On a segment, c'(t) / (c(t) - z) is the sum of 1 / (t - t_r) over the roots t_r of c(t) = z.
// Integrals over a curve therefore become integrals over the unit interval, one for each root.
#pragma once

#include <array>

#include "core/geometry/curve.h"

namespace holomorph {

/// A point, stored as a base (such as a vertex) and an offset from the base. Differences from
/// points near the base keep all their digits.
struct FinePoint {
  Complex base, offset;

  FinePoint(Complex z) : base(z) {}
  FinePoint(Complex from, Complex by) : base(from), offset(by) {}
  /// The point, rounded.
  Complex plain() const { return base + offset; }
};
inline Complex operator-(Complex a, const FinePoint& b) {
  return (a - b.base) - b.offset;
}

/// The coefficients of the curve in powers of t.
Points powers_about_start(std::span<const Complex> controls);
/// The coefficients of the curve in powers of 2 t - 1.
Points powers_about_middle(std::span<const Complex> controls);

/// A root t of c(t) = z as s = t and q = 1 - t, each to full relative precision. Near an end of the
/// segment, the smaller of the two is the one that matters.
struct Root {
  Complex s, q;
};

class SegmentPolynomial {
 public:
  /// From the control points, at most kHighestDegree + 1 of them (checked). The degree of a
  /// degree-raised curve is reduced to the original one.
  explicit SegmentPolynomial(std::span<const Complex> controls);

  /// The number of roots, which is the true degree; 0 for a single point.
  int degree() const { return static_cast<int>(middle_.size()) - 1; }
  /// Whether the segment is a straight edge traversed at constant speed.
  bool is_straight() const { return degree() == 1; }
  Complex start() const { return start_[0]; }
  Complex end() const { return end_[0]; }
  /// The largest modulus of a control point.
  double magnitude() const { return magnitude_; }
  /// The bounding box of the control points.
  const Box& box() const { return box_; }

  /// Writes the degree() roots of c(t) = z. If `near` is given, the iteration starts from these
  /// roots, which should belong to a nearby z. Uses Aberth's method, followed by Newton's method on
  /// the expansion about the nearer end. A double root is necessarily accurate to only half the
  /// digits. Cost: about 100 ns per root.
  void roots(const FinePoint& z, std::span<Root> out, std::span<const Root> near = {}) const;

  /// The Taylor coefficients c^(j)(t) / j! at a parameter, for j < out.size(). They are 0 for j
  /// above the degree. Cost O(degree^2).
  void taylor(const Root& at, std::span<Complex> out) const;
  /// c(t) and c'(t).
  Complex at(const Root& parameter) const { return fine_at(parameter).plain(); }
  /// c(t) as an offset from the nearer end.
  FinePoint fine_at(const Root& parameter) const;
  Complex derivative(const Root& at) const;

 private:
  void refine(const FinePoint& z, Root& root) const;

  // The coefficients of c in powers of 2 t - 1, of s = t and of q = 1 - t.
  Points middle_, start_, end_;
  Box box_;
  double magnitude_ = 0;
};

}  // namespace holomorph
