// A barrier that keeps a map within bounds on its distortion.
//
// At a point with u = ln |f_z| and r = |nu|, the bounds of Bounds hold if
//     r < k,   u + r < ln Sigma   and   r < 1 - sigma e^-u.
// The second condition is slightly stronger than its bound, e^u (1 + r) <= Sigma, so that each of
// the three describes a convex set in (u, nu). The barrier is the sum of -ln(g^2 - r^2) over them,
// where g is k, ln Sigma - u or 1 - sigma e^-u. It is convex, because g is concave. A linear term
// makes it flat where u = nu = 0, if the bounds allow that, so that it does not move rigid motions.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/bounded/certificate.h"
#include "core/isometric/energy.h"

namespace holomorph {

class Barrier {
 public:
  explicit Barrier(const Bounds& bounds)
      : k_(bounds.k), sigma_(bounds.sigma), log_Sigma_(std::log(bounds.Sigma)) {
    for (const Room& g : rooms(0))
      if (!(g.value > 0)) return;
    for (const Room& g : rooms(0)) flat_ += growth(g, g.value * g.value);
  }

  /// Infinite outside the sets.
  double value(double u, double a, double b) const {
    const double p = a * a + b * b;
    double sum = flat_ * u;
    for (const Room& g : rooms(u)) {
      if (!(g.value > 0) || !(g.value * g.value > p))
        return std::numeric_limits<double>::infinity();
      sum -= std::log(g.value * g.value - p);
    }
    return sum;
  }

  /// Adds the barrier's value and derivatives at a point of all three sets, times a weight.
  void add_to(IsometricEnergy::Value& to, double weight, double u, double a, double b) const {
    const double p = a * a + b * b;
    double grown = 0;
    for (const Room& g : rooms(u)) {
      const double d = g.value * g.value - p;
      const Eigen::Vector3d slope(growth(g, d), -2 * a / d, -2 * b / d);
      grown += slope[0];
      to.value -= weight * std::log(d);
      to.gradient.tail<2>() -= weight * slope.tail<2>();
      to.hessian += weight * slope * slope.transpose();
      to.hessian.diagonal() -=
          weight * 2 / d * Eigen::Vector3d(g.slope * g.slope + g.value * g.curvature, -1, -1);
    }
    // In this order, the sum is exactly 0 where the barrier is flat.
    to.gradient[0] += weight * (flat_ - grown);
    to.value += weight * flat_ * u;
  }

 private:
  /// g and its derivatives in u.
  struct Room {
    double value, slope, curvature;
  };
  std::array<Room, 3> rooms(double u) const {
    const double shrunk = sigma_ * std::exp(-u);
    return {{{k_, 0, 0}, {log_Sigma_ - u, -1, 0}, {1 - shrunk, shrunk, -shrunk}}};
  }

  /// The derivative of ln d in u, where d = g^2 - r^2.
  static double growth(const Room& g, double d) { return 2 * g.value * g.slope / d; }

  double k_, sigma_, log_Sigma_;
  double flat_ = 0;  ///< the slope of the linear term
};

}  // namespace holomorph
