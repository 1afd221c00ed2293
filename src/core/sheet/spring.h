// The energy of a handle of a sheet that misses its target.
#pragma once

#include <cmath>

namespace holomorph {

/// A spring that gives way. At the distance r from the target, its force is
///     2 w r / sqrt(1 + (2 w r / F)^2) + 2 v r,
/// which is 2 w r nearby and F + 2 v r far away (pseudo-Huber loss). With 1 / F = 0, it never gives
/// way. Energies are functions of r^2, which are smooth at the target.
struct Spring {
  double weight = 0;         ///< w, per squared unit of the plane
  double inverse_force = 0;  ///< 1 / F
  double far_weight = 0;     ///< v

  /// The same spring without a limit.
  Spring firm() const { return {weight}; }

  double value(double squared) const {
    return (2 * weight / (1 + root(squared)) + far_weight) * squared;
  }
  double slope(double squared) const { return weight / root(squared) + far_weight; }
  /// The second derivative, which is not positive.
  double curvature(double squared) const {
    const double by = 2 * weight * inverse_force, at = root(squared);
    return -0.5 * weight * by * by / (at * at * at);
  }

 private:
  double root(double squared) const {
    const double by = 2 * weight * inverse_force;
    return std::sqrt(1 + by * by * squared);
  }
};

/// A spring with a multiple of the energy.
inline Spring operator*(double factor, const Spring& spring) {
  return {factor * spring.weight, spring.inverse_force / factor, factor * spring.far_weight};
}

}  // namespace holomorph
