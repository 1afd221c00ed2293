// Affine maps of the plane in complex form.
#pragma once

#include <array>

#include "core/types.h"

namespace holomorph {

/// w -> linear w + anti conj(w) + shift. By default the identity. Preserves orientation if
/// |linear| > |anti|.
struct Affine {
  Complex linear = 1, anti = 0, shift = 0;

  Complex operator()(Complex w) const { return direction(w) + shift; }
  /// The image of a vector.
  Complex direction(Complex v) const { return linear * v + anti * std::conj(v); }
  double determinant() const { return std::norm(linear) - std::norm(anti); }
  bool operator==(const Affine&) const = default;
};

/// x + iy -> (a x + c y + e) + i (b x + d y + f).
inline Affine affine_of_matrix(double a, double b, double c, double d, double e, double f) {
  return {0.5 * Complex(a + d, b - c), 0.5 * Complex(a - d, b + c), {e, f}};
}
/// The numbers a to f of affine_of_matrix.
inline std::array<double, 6> matrix_of(const Affine& map) {
  const Complex x = map.direction(1), y = map.direction(kI);
  return {x.real(), x.imag(), y.real(), y.imag(), map.shift.real(), map.shift.imag()};
}

/// w -> outer(inner(w)).
inline Affine composed(const Affine& outer, const Affine& inner) {
  return {outer.linear * inner.linear + outer.anti * std::conj(inner.anti),
          outer.linear * inner.anti + outer.anti * std::conj(inner.linear), outer(inner.shift)};
}
/// The inverse. The determinant must not be 0.
inline Affine inverse(const Affine& map) {
  const double d = map.determinant();
  Affine inverse{std::conj(map.linear) / d, -map.anti / d, 0};
  inverse.shift = -inverse.direction(map.shift);
  return inverse;
}

}  // namespace holomorph
