// A polygon's Cauchy map in 50 digits: the reference for evaluation next to the boundary.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "core/geometry/cage.h"

namespace holomorph::exact {

using Real = boost::multiprecision::cpp_bin_float_50;

struct Number {
  Real re = 0, im = 0;

  Number() = default;
  Number(Real x, Real y) : re(std::move(x)), im(std::move(y)) {}
  Number(Complex z) : re(z.real()), im(z.imag()) {}

  friend Number operator+(const Number& a, const Number& b) { return {a.re + b.re, a.im + b.im}; }
  friend Number operator-(const Number& a, const Number& b) { return {a.re - b.re, a.im - b.im}; }
  friend Number operator*(const Number& a, const Number& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Number operator/(const Number& a, const Number& b) {
    const Real n = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
  }
  Real modulus() const { return sqrt(re * re + im * im); }
  Complex rounded() const { return {static_cast<double>(re), static_cast<double>(im)}; }
};

/// f = z + the Cauchy integral of displacements that are linear along the edges of a
/// counter-clockwise polygon, and f'. For a point outside, the nearest boundary point is used.
struct Image {
  Complex f, df;
};
inline Image image_of(const Points& polygon, const Points& displaced, Complex at) {
  const size_t n = polygon.size();
  const Real pi = boost::math::constants::pi<Real>();
  const auto edge = [&](size_t e) { return Number(polygon[(e + 1) % n]) - Number(polygon[e]); };
  // Whether the point is inside; if not, the nearest edge and the parameter on it.
  Real turns = 0, distance = -1;
  size_t own = n;
  Real share = 0;
  const Number z(at);
  for (size_t e = 0; e < n; ++e) {
    const Number s = (z - Number(polygon[e])) / edge(e);
    if (s.im != 0) turns += atan2(s.im, -(s.re - s.re * s.re - s.im * s.im));
    Real t = s.re;
    if (t < 0) t = 0;
    if (t > 1) t = 1;
    const Real here = (s - Number(t, 0)).modulus() * edge(e).modulus();
    if (distance < 0 || here < distance) distance = here, own = e, share = t;
  }
  if (turns > pi && distance > 0) own = n;
  if (own < n && share == 1) own = (own + 1) % n, share = 0;
  const bool vertex = own < n && share == 0;
  const Number here = own < n ? Number(polygon[own]) + Number(share, 0) * edge(own) : z;
  Number sum, slopes;
  const size_t before = (own + n - 1) % n;
  for (size_t e = 0; e < n; ++e) {
    const Number d0(displaced[e]), step = Number(displaced[(e + 1) % n]) - d0;
    if (vertex && e == own) {
      const Number in = edge(before), out = edge(own);
      Real angle = -atan2((out / in).im, (out / in).re);  // the turn to the right
      // The sum of L over both edges: ln |out / in| + i (2 pi - the inner angle).
      sum = sum + d0 * Number(log(out.modulus() / in.modulus()), pi - angle) + step;
      continue;
    }
    if (vertex && e == before) {
      sum = sum + step;
      continue;
    }
    const Number s = e == own ? Number(share, 0) : (here - Number(polygon[e])) / edge(e);
    const Number q = Number(1, 0) - s, ratio = q / s;
    const Number l(log(ratio.modulus()), e == own ? pi : atan2(-ratio.im, -ratio.re));
    sum = sum + (d0 + s * step) * l + step;
    slopes = slopes + step / edge(e) * l;
  }
  const Number factor = Number(1, 0) / Number(0, 2 * pi);
  return {(here + factor * sum).rounded(), (Number(1, 0) + factor * slopes).rounded()};
}

}  // namespace holomorph::exact
