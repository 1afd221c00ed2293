// Projections that alternate between two steps: project each element separately, then find the
// nearest map whose elements fit together.
#include <algorithm>
#include <array>
#include <limits>

#include "core/compared/projections.h"

namespace holomorph {

Element nearest_bounded(const Element& element, const Bounds& bounds) {
  const double a = element.head<2>().norm(), b = element.tail<2>().norm();
  // The polygon of allowed (|f_z|, |f_zbar|). Its two upper corners coincide when the bounds sigma
  // and Sigma imply the bound k.
  const double k = bounds.k, low = bounds.sigma / (1 - k), high = bounds.Sigma / (1 + k),
               middle = 0.5 * (bounds.Sigma + bounds.sigma);
  const bool cut = low < high;
  const Complex peak(middle, middle - bounds.sigma);
  const std::array<Complex, 4> corners{Complex(bounds.sigma), Complex(bounds.Sigma),
                                       cut ? Complex(high, k * high) : peak,
                                       cut ? Complex(low, k * low) : peak};
  const Complex at(a, b);
  Complex nearest = at;
  const bool inside = b <= k * a && a - b >= bounds.sigma && a + b <= bounds.Sigma;
  if (!inside) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < corners.size(); ++i) {
      const Complex from = corners[i], difference = corners[(i + 1) % corners.size()] - from;
      const double along =
          std::norm(difference) > 0
              ? std::clamp(dot(at - from, difference) / std::norm(difference), 0.0, 1.0)
              : 0;
      const Complex candidate = from + along * difference;
      if (std::abs(candidate - at) < least) least = std::abs(candidate - at), nearest = candidate;
    }
  }
  Element result = Element::Zero();
  if (a > 0)
    result.head<2>() = element.head<2>() / a * nearest.real();
  else
    result[0] = nearest.real();
  if (b > 0) result.tail<2>() = element.tail<2>() / b * nearest.imag();
  return result;
}

namespace {

constexpr double kProjected = 1e-6;  ///< largest distance of an element from its projection

VectorXd projected(const VectorXd& y, const Bounds& bounds) {
  VectorXd result(y.size());
  for (Index i = 0; 4 * i < y.size(); ++i)
    result.segment<4>(4 * i) = nearest_bounded(y.segment<4>(4 * i), bounds);
  return result;
}

VectorXd weighted(const DerivativeOperator& t, const VectorXd& y) {
  VectorXd result = y;
  for (Index i = 0; i < t.elements(); ++i) result.segment<4>(4 * i) *= t.weights()[i];
  return result;
}

std::vector<Eigen::Matrix4d> identity_blocks(const DerivativeOperator& t) {
  std::vector<Eigen::Matrix4d> blocks;
  for (Index i = 0; i < t.elements(); ++i)
    blocks.push_back(t.weights()[i] * Eigen::Matrix4d::Identity());
  return blocks;
}

/// One half-space per element: normal . y <= limit, or no constraint if the normal is 0.
struct HalfSpaces {
  VectorXd normals, limits;
};

/// Minimizes the weighted sum of |T x - g|^2 / 2 subject to normal_i . (T x)_i <= limit_i for all
/// nonzero normal_i. The primal-dual interior-point method can start from any x. Returns early when
/// `stop` is requested.
VectorXd quadratic_program(DerivativeOperator& t, const VectorXd& g, VectorXd x,
                           const HalfSpaces& spaces, const std::stop_token& stop) {
  const VectorXd &normals = spaces.normals, &limits = spaces.limits;
  std::vector<Index> rows;
  for (Index i = 0; i < t.elements(); ++i)
    if (!normals.segment<4>(4 * i).isZero(0)) rows.push_back(i);
  const Index count = static_cast<Index>(rows.size());
  const auto along = [&](const VectorXd& y) {
    VectorXd result(count);
    for (Index r = 0; r < count; ++r)
      result[r] = normals.segment<4>(4 * rows[r]).dot(y.segment<4>(4 * rows[r]));
    return result;
  };
  VectorXd limit(count);
  for (Index r = 0; r < count; ++r) limit[r] = limits[rows[r]];
  const double scale = 1 / static_cast<double>(t.elements());
  VectorXd s = (limit - along(t.apply(x))).cwiseMax(0.1),
           z = VectorXd::Constant(count, 0.1 * scale);
  constexpr int kMaxIterations = 40;
  for (int iteration = 0; iteration < kMaxIterations && !stop.stop_requested(); ++iteration) {
    const VectorXd y = t.apply(x), off = along(y) + s - limit;
    const double mu = count > 0 ? s.dot(z) / static_cast<double>(count) : 0;
    std::vector<Eigen::Matrix4d> blocks = identity_blocks(t);
    VectorXd pull = weighted(t, y - g);
    const double center = 0.2 * mu;
    for (Index r = 0; r < count; ++r) {
      const Element n = normals.segment<4>(4 * rows[r]);
      blocks[static_cast<size_t>(rows[r])] += z[r] / s[r] * n * n.transpose();
      pull.segment<4>(4 * rows[r]) += (z[r] * off[r] + center) / s[r] * n;
    }
    t.factor(blocks);
    const VectorXd dx = t.solve(-t.adjoint(pull));
    const VectorXd ds = -off - along(t.apply(dx));
    const VectorXd dz = (center - s.array() * z.array() - z.array() * ds.array()) / s.array();
    double length = 1;
    for (Index r = 0; r < count; ++r) {
      if (ds[r] < 0) length = std::min(length, -0.95 * s[r] / ds[r]);
      if (dz[r] < 0) length = std::min(length, -0.95 * z[r] / dz[r]);
    }
    x += length * dx;
    s += length * ds;
    z += length * dz;
    const double residual = count > 0 ? off.cwiseAbs().maxCoeff() : 0;
    if (mu < 1e-9 * scale && residual < 1e-9 && length > 0.9) break;
    if (count == 0) break;
  }
  return x;
}

}  // namespace

Projected by_half_spaces(DerivativeOperator& t, const VectorXd& start,
                         const ProjectionSettings& settings) {
  Projected result{start};
  constexpr int kMaxIterations = 50;
  for (; result.iterations < kMaxIterations && !settings.stop.stop_requested();
       ++result.iterations) {
    const VectorXd y = t.apply(result.x), p = projected(y, settings.bounds);
    HalfSpaces spaces{VectorXd::Zero(y.size()), VectorXd::Zero(t.elements())};
    double worst = 0;
    for (Index i = 0; i < t.elements(); ++i) {
      const Element difference = y.segment<4>(4 * i) - p.segment<4>(4 * i);
      const double length = difference.norm();
      worst = std::max(worst, length);
      if (length == 0) continue;
      spaces.normals.segment<4>(4 * i) = difference / length;
      spaces.limits[i] = difference.dot(p.segment<4>(4 * i)) / length;
    }
    result.settled = worst < kProjected;
    if (result.settled) break;
    result.x = quadratic_program(t, y, result.x, spaces, settings.stop);
  }
  return result;
}

Projected by_tangent_planes(DerivativeOperator& t, const VectorXd& start,
                            const ProjectionSettings& settings) {
  Projected result{start};
  t.factor(identity_blocks(t));
  constexpr int kMaxIterations = 3000;
  for (; result.iterations < kMaxIterations && !settings.stop.stop_requested();
       ++result.iterations) {
    const VectorXd y = t.apply(result.x), difference = y - projected(y, settings.bounds);
    double worst = 0;
    for (Index i = 0; i < t.elements(); ++i)
      worst = std::max(worst, difference.segment<4>(4 * i).norm());
    result.settled = worst < kProjected;
    if (result.settled) break;
    const VectorXd pull = t.adjoint(weighted(t, difference)), dx = t.solve(pull);
    const double step = difference.dot(weighted(t, difference)) / pull.dot(dx);
    result.x -= step * dx;
  }
  return result;
}

}  // namespace holomorph
