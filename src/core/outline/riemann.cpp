// Boundary points become real when their arc is opened. The side of the arc that faces the interior
// is mapped to the negative real axis.
#include "core/outline/riemann.h"

#include <limits>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/geometry/cage.h"

namespace holomorph {
namespace {

/// The root in the upper half-plane; for a positive number, the root with the sign of `side`. The
/// overflow handling of std::sqrt takes twice as long as everything else, so std::sqrt is called
/// only where overflow or underflow is possible.
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

}  // namespace

Complex RiemannMap::straightened(const Arc& arc, Complex z) {
  return arc.scale * quotient(z, {1 - z.real() * arc.inverse_b, -z.imag() * arc.inverse_b});
}

void RiemannMap::OpenPoints::open(const Arc& arc) {
  constexpr double kFar = 1e100;  // beyond this, c is negligible
  double before = 0, before_straight = 0, before_below = 0;
  for (size_t i = 0; i < at.size(); ++i) {
    const bool infinite = std::isinf(at[i]), last = i + 1 == at.size();
    const double below = 1 - at[i] * arc.inverse_b;
    const double straight = infinite ? -arc.scale / arc.inverse_b : arc.scale * at[i] / below;
    double opened = straight;
    if (last) {
      opened = -arc.c;
    } else if (std::abs(straight) <= kFar) {
      opened = std::copysign(std::sqrt(straight * straight + arc.c * arc.c), straight);
    }
    if (i > 0) {
      double& step = steps[i - 1];
      if (std::isfinite(step) && (before < 0) == (opened < 0) && std::abs(opened) <= kFar)
        step *=
            arc.scale / (below * before_below) * (straight + before_straight) / (opened + before);
      else
        step = opened - before;
    }
    at[i] = before = opened;
    before_straight = straight;
    before_below = below;
  }
  at.push_back(0);
  steps.push_back(arc.c);
}

Complex RiemannMap::open(const Arc& arc, Complex z) {
  const Complex straight = straightened(arc, z);
  return upper_root(
      {(straight.real() - straight.imag()) * (straight.real() + straight.imag()) + arc.c * arc.c,
       2 * straight.real() * straight.imag()},
      straight.real());
}

RiemannMap::RiemannMap(std::span<const Complex> polygon, Complex center) {
  const size_t n = polygon.size();
  check(n >= 3, "Riemann map: a polygon with at least three vertices");
  first_ = polygon[0];
  second_ = polygon[1];
  // `inside` holds vertices that are still inside; `done` holds opened vertices on the real axis.
  std::vector<Complex> inside;
  for (size_t i = 2; i < n; ++i) inside.push_back(first_root(polygon[i]));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  OpenPoints done{{kInfinity, 0}, {kInfinity}};
  Complex middle = first_root(center);
  for (size_t k = 0; k < inside.size(); ++k) {
    const Arc centered = centering(middle);
    const Complex a = straightened(centered, inside[k]);
    const double size = std::norm(a);
    if (!(a.imag() > 0) || !std::isfinite(size))
      throw Error(ErrorKind::bad_input,
                  "the outline cannot be mapped to a disk: it touches itself near " +
                      point_text(polygon[k + 2]),
                  polygon[k + 2]);
    const Arc arc{centered.scale, centered.inverse_b + centered.scale * a.real() / size,
                  size / a.imag()};
    arcs_.push_back(arc);
    done.open(arc);
    for (size_t i = k + 1; i < inside.size(); ++i) inside[i] = open(arc, inside[i]);
    middle = open(arc, middle);
  }
  last_ = centering(middle);
  last_.inverse_b = 1 / done.at[0];
  const Complex quarter = straightened(last_, middle);
  center_ = -quarter * quarter;
  set_angles(done);
}

// The first vertex is at infinity. The others are on the negative real axis, as negative squares.
void RiemannMap::set_angles(const OpenPoints& points) {
  const Index n = static_cast<Index>(points.at.size());
  const double first = points.at[0], u = center_.real(), v = center_.imag();
  angles_.resize(n);
  steps_.resize(n);
  angles_[0] = 0;
  double from_first = 0, before = 0, before_below = 1;
  for (Index i = 1; i < n; ++i) {
    const double at = points.at[static_cast<size_t>(i)],
                 step = points.steps[static_cast<size_t>(i - 1)];
    from_first += step;
    const double below = -from_first / first, root = last_.scale * at / below;
    const double x = -root * root - u;
    if (i == 1) {
      steps_[0] = 2 * std::atan2(v, -x);
    } else {
      const double root_step = last_.scale * step / (below * before_below);
      steps_[i - 1] =
          2 * std::atan2(-root_step * (root + before) * v, v * v + x * (-before * before - u));
    }
    angles_[i] = angles_[i - 1] + steps_[i - 1];
    before = root;
    before_below = below;
  }
  steps_[n - 1] = 2 * std::atan2(v, -u);
}

Complex RiemannMap::first_root(Complex z) const {
  const Complex w = kI * std::sqrt((z - second_) / (z - first_));
  return w.imag() < 0 ? -w : w;
}

/// The map that fixes 0 and takes a point of the upper half-plane to i.
RiemannMap::Arc RiemannMap::centering(Complex z) {
  return {z.imag() / std::norm(z), z.real() / std::norm(z), 0};
}

Complex RiemannMap::in_half_plane(Complex z) const {
  Complex w = first_root(z);
  for (const Arc& arc : arcs_) w = open(arc, w);
  const Complex straight = straightened(last_, w);
  return -straight * straight;
}

Complex RiemannMap::at(Complex z) const {
  const Complex w = in_half_plane(z);
  return (w - center_) / (w - std::conj(center_));
}

}  // namespace holomorph
