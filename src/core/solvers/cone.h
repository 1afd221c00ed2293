// The second-order cone in three dimensions: |w| <= height, and its Jordan algebra.
//
// Uses the Nesterov-Todd scaling.
#pragma once

#include <cmath>
#include <limits>

#include "core/types.h"

namespace holomorph {

using Cone3 = Eigen::Vector3d;  // (height, w)

/// height^2 - |w|^2, computed without subtracting squares.
inline double det(const Cone3& v) {
  const double r = std::hypot(v[1], v[2]);
  return (v[0] - r) * (v[0] + r);
}
inline bool is_inside(const Cone3& v) {
  return v[0] > 0 && det(v) > 0;
}

/// Solves v o x = r for x, where o is the Jordan product.
inline Cone3 divided(const Cone3& v, const Cone3& r) {
  Cone3 x;
  x[0] = (v[0] * r[0] - v[1] * r[1] - v[2] * r[2]) / det(v);
  x.tail<2>() = (r.tail<2>() - x[0] * v.tail<2>()) / v[0];
  return x;
}
inline Cone3 jordan(const Cone3& a, const Cone3& b) {
  Cone3 product;
  product[0] = a.dot(b);
  product.tail<2>() = a[0] * b.tail<2>() + b[0] * a.tail<2>();
  return product;
}
inline Cone3 reflected(const Cone3& v) {
  return {v[0], -v[1], -v[2]};
}

/// The step length along d from v to the boundary of the cone, or infinity if d never reaches it.
inline double step_to_boundary(const Cone3& v, const Cone3& d) {
  const double a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2],
               b = v[0] * d[0] - v[1] * d[1] - v[2] * d[2], c = det(v);
  double step = d[0] < 0 ? -v[0] / d[0] : std::numeric_limits<double>::infinity();
  const double root = b * b - a * c;
  // The smallest positive root of a t^2 + 2 b t + c.
  if (a < 0)
    step = std::min(step, (b + std::sqrt(std::max(root, 0.0))) / -a);
  else if (b < 0 && root > 0)
    step = std::min(step, c / (-b + std::sqrt(root)));
  return step;
}

/// The scaling W with W z = W^-1 s.
struct Scaling {
  double eta = 1;
  Cone3 w{1, 0, 0};

  Scaling() = default;
  Scaling(const Cone3& s, const Cone3& z) {
    const double ds = det(s), dz = det(z);
    const Cone3 s1 = s / std::sqrt(ds), z1 = z / std::sqrt(dz);
    eta = std::sqrt(std::sqrt(ds / dz));
    w = (s1 + reflected(z1)) / std::sqrt(2 * (1 + s1.dot(z1)));
  }
  static Cone3 times(const Cone3& w, const Cone3& v) {
    const double along = w[1] * v[1] + w[2] * v[2], lift = v[0] + along / (1 + w[0]);
    return {w[0] * v[0] + along, v[1] + w[1] * lift, v[2] + w[2] * lift};
  }
  Cone3 apply(const Cone3& v) const { return eta * times(w, v); }
  Cone3 undo(const Cone3& v) const { return times(reflected(w), v) / eta; }
  Eigen::Matrix3d inverse_square() const {
    const Cone3 v = reflected(w);
    Eigen::Matrix3d m = 2 * v * v.transpose();
    m(0, 0) -= 1, m(1, 1) += 1, m(2, 2) += 1;
    return m / (eta * eta);
  }
};

}  // namespace holomorph
