// Complex arithmetic written out: std::complex's operators guard against infinities and are several
// times slower for it.
#pragma once

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

}  // namespace holomorph
