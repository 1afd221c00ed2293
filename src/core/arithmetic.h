// Complex arithmetic, written out explicitly. The operators of std::complex handle infinities,
// which makes them several times slower.
#pragma once

#include <cmath>

#include "core/types.h"

namespace holomorph {

inline Complex times(Complex x, Complex y) {
  return {x.real() * y.real() - x.imag() * y.imag(), x.real() * y.imag() + x.imag() * y.real()};
}
inline Complex inverse(Complex x) {
  return std::conj(x) / std::norm(x);
}
inline Complex quotient(Complex x, Complex y) {
  const double over = 1 / std::norm(y);
  return {over * dot(y, x), over * cross(y, x)};
}

/// The cubic polynomial with value 0 at 0, 1 at 1, and slope 0 at both.
inline double smoothstep(double u) {
  return u * u * (3 - 2 * u);
}

/// Adds a whole multiple of `turn` to `number` to get the smallest result that is at least
/// `before`. A result that falls short of `before` only by rounding counts as equal to it.
inline double next_modulo(double before, double number, double turn) {
  constexpr double kRounding = 1e-6;
  const double step = (number - before) / turn, on = step - std::floor(step);
  return on > 1 - kRounding ? before : before + on * turn;
}

}  // namespace holomorph
