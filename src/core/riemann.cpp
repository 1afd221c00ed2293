// Points of the boundary are real once their arc is open: those seen from inside are negative.
#include "core/riemann.h"

#include <limits>

#include "core/arithmetic.h"
#include "core/cage.h"
#include "core/error.h"

namespace holomorph {
namespace {

/// The root in the upper half-plane; of a positive number the one with the sign of `side`.
/// std::sqrt's care for overflow costs twice the time of all the rest: it is asked where it
/// matters.
Complex upper_root(Complex w, double side) {
  const double size = std::sqrt(w.real() * w.real() + w.imag() * w.imag()),
               larger = std::sqrt(0.5 * (size + std::abs(w.real())));
  if (!(size > 1e-150 && size < 1e150)) {
    Complex root = std::sqrt(w);
    if (root.imag() < 0 || (root.imag() == 0 && root.real() * side < 0)) root = -root;
    return root;
  }
  const double smaller = 0.5 * w.imag() / larger;
  if (w.real() < 0) return {std::copysign(std::abs(smaller), w.imag()), larger};
  if (smaller == 0) return {std::copysign(larger, side), 0};
  return smaller > 0 ? Complex(larger, smaller) : Complex(-larger, -smaller);
}

/// A boundary point on the real axis, which may be infinite: z / (1 - z / b), then the root.
double open_real(double inverse_b, double c, double x) {
  const double straight = std::isinf(x) ? -1 / inverse_b : x / (1 - x * inverse_b);
  constexpr double kFar = 1e100;  // where c is nothing beside it
  if (std::abs(straight) > kFar) return straight;
  return std::copysign(std::sqrt(straight * straight + c * c), straight);
}

}  // namespace

Complex RiemannMap::open(const Arc& arc, Complex z) {
  const Complex straight = quotient(z, {1 - z.real() * arc.inverse_b, -z.imag() * arc.inverse_b});
  return upper_root(
      {(straight.real() - straight.imag()) * (straight.real() + straight.imag()) + arc.c * arc.c,
       2 * straight.real() * straight.imag()},
      straight.real());
}

RiemannMap::RiemannMap(std::span<const Complex> polygon, Complex centre) {
  const size_t n = polygon.size();
  check(n >= 3, "Riemann map: a polygon of three vertices");
  first_ = polygon[0];
  second_ = polygon[1];
  // Vertices that are still inside, and on the axis those that are done.
  std::vector<Complex> inside;
  for (size_t i = 2; i < n; ++i) {
    const Complex ratio = (polygon[i] - second_) / (polygon[i] - first_);
    inside.push_back(kI * std::sqrt(ratio));
  }
  std::vector<double> done{std::numeric_limits<double>::infinity(), 0};
  for (size_t k = 0; k < inside.size(); ++k) {
    const Complex a = inside[k];
    const double size = std::norm(a);
    if (!(a.imag() > 0) || !std::isfinite(size))
      throw Error(ErrorKind::bad_input,
                  "the outline cannot be mapped to a disk: it touches itself near " +
                      point_text(polygon[k + 2]),
                  polygon[k + 2]);
    const Arc arc{a.real() / size, size / a.imag()};
    arcs_.push_back(arc);
    for (double& x : done) x = x == 0 ? -arc.c : open_real(arc.inverse_b, arc.c, x);
    for (size_t i = k + 1; i < inside.size(); ++i) inside[i] = open(arc, inside[i]);
    done.push_back(0);
  }
  last_inverse_ = 1 / done[0];
  centre_ = in_half_plane(centre);
  angles_.resize(static_cast<Index>(n));
  for (size_t i = 0; i < n; ++i) {
    const double straight = done[i] / (1 - done[i] * last_inverse_);
    const Complex on_axis(-straight * straight, 0);
    const Complex on_circle =
        i == 0 ? Complex(1) : (on_axis - centre_) / (on_axis - std::conj(centre_));
    const double angle = std::arg(on_circle);
    angles_[static_cast<Index>(i)] =
        i == 0 ? angle : next_in_turn(angles_[static_cast<Index>(i) - 1], angle, 2 * kPi);
  }
}

Complex RiemannMap::in_half_plane(Complex z) const {
  Complex w = kI * std::sqrt((z - second_) / (z - first_));
  if (w.imag() < 0) w = -w;
  for (const Arc& arc : arcs_) w = open(arc, w);
  const Complex straight = w / (1.0 - w * last_inverse_);
  return -straight * straight;
}

Complex RiemannMap::at(Complex z) const {
  const Complex w = in_half_plane(z);
  return (w - centre_) / (w - std::conj(centre_));
}

}  // namespace holomorph
