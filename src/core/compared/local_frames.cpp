// A barrier for four second-order cones per element, with an additional unknown r >= |f_z|:
//   |f_zbar| <= k s, |f_zbar| <= s - sigma, |f_z| <= r, |f_zbar| <= Sigma - r, s = Re(f_z / frame).
#include <Eigen/LU>

#include "core/compared/projections.h"
#include "core/solvers/cone.h"

namespace holomorph {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;  // (f_z, f_zbar, r)
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using Cones = Eigen::Matrix<double, 12, 5>;  // linear parts of four cones (height, w)
using Offsets = Eigen::Matrix<double, 12, 1>;

constexpr int kMostFrames = 20, kMostNewton = 12;
constexpr double kLeastAngle = 1e-3;
constexpr double kSettledChange = 1e-4;  ///< largest change of an element

struct FrameBarrier {
  double value = 0;
  Vector5 gradient = Vector5::Zero();
  Matrix5 hessian = Matrix5::Zero();
};

class LocalFrames {
 public:
  LocalFrames(DerivativeOperator& t, const VectorXd& g, const ProjectionSettings& settings)
      : t_(t), g_(g), bounds_(settings.bounds), stop_(settings.stop) {
    bounds_.k = std::max(bounds_.k, kLeastAngle);
    const double middle = std::exp(bounds_.middle());
    x_ = t.similarity(middle);
    frames_.assign(static_cast<size_t>(t.elements()), 1);
    r_ = VectorXd::Constant(t.elements(), 0.5 * (middle + bounds_.Sigma));
  }

  Projected run() {
    Projected result;
    for (; !is_over(result); ++result.iterations) {
      const VectorXd before = t_.apply(x_);
      descend();
      const VectorXd after = t_.apply(x_);
      result.settled = (after - before).cwiseAbs().maxCoeff() < kSettledChange;
      for (Index i = 0; i < t_.elements(); ++i) {
        const Complex fz(after[4 * i], after[4 * i + 1]);
        frames_[static_cast<size_t>(i)] = fz / std::abs(fz);
      }
    }
    result.x = x_;
    return result;
  }

 private:
  bool is_over(const Projected& result) const {
    return result.settled || result.iterations == kMostFrames || stop_.stop_requested();
  }

  Vector5 point(const VectorXd& y, const VectorXd& r, Index i) const {
    Vector5 p;
    p << y.segment<4>(4 * i), r[i];
    return p;
  }

  /// The four cones of an element, for its frame.
  Cones cones(Index i) const {
    const Complex frame = frames_[static_cast<size_t>(i)];
    Vector5 s = Vector5::Zero();
    s[0] = frame.real(), s[1] = frame.imag();
    Cones cones = Cones::Zero();
    cones.row(0) = bounds_.k * s.transpose();
    cones.row(3) = s.transpose();
    cones(6, 4) = 1;
    cones(9, 4) = -1;
    for (const int c : {0, 1, 3}) cones(3 * c + 1, 2) = cones(3 * c + 2, 3) = 1;
    cones(7, 0) = cones(8, 1) = 1;
    return cones;
  }
  Offsets offsets() const {
    Offsets offsets = Offsets::Zero();
    offsets[3] = -bounds_.sigma;
    offsets[9] = bounds_.Sigma;
    return offsets;
  }

  /// The sum of -ln (height^2 - |w|^2) over all cones; infinite outside the cones.
  double barrier_value(const VectorXd& y, const VectorXd& r) const {
    double sum = 0;
    for (Index i = 0; i < t_.elements(); ++i) {
      const Offsets s = cones(i) * point(y, r, i) + offsets();
      for (int c = 0; c < 4; ++c) {
        const Cone3 cone = s.segment<3>(3 * c);
        if (!is_inside(cone)) return std::numeric_limits<double>::infinity();
        sum -= std::log(det(cone));
      }
    }
    return sum;
  }

  FrameBarrier barrier(const VectorXd& y, Index i) const {
    const Cones a = cones(i);
    const Offsets s = a * point(y, r_, i) + offsets();
    FrameBarrier result;
    for (int c = 0; c < 4; ++c) {
      const Cone3 cone = s.segment<3>(3 * c), q = reflected(cone);
      const auto rows = a.middleRows<3>(3 * c);
      const double d = det(cone);
      Eigen::Matrix3d h = 4 / (d * d) * q * q.transpose();
      h.diagonal() += 2 / d * Cone3(-1, 1, 1);
      result.gradient -= 2 / d * rows.transpose() * q;
      result.hessian += rows.transpose() * h * rows;
    }
    return result;
  }

  double distance(const VectorXd& y) const {
    double sum = 0;
    for (Index i = 0; i < t_.elements(); ++i)
      sum += t_.weights()[i] * (y - g_).segment<4>(4 * i).squaredNorm();
    return 0.5 * sum;
  }

  /// Solves the convex problem for the current frames along the central path.
  void descend() {
    const double least = 1e-6 / static_cast<double>(t_.elements());
    for (double mu = 0.1 / static_cast<double>(t_.elements()); mu > least; mu *= 0.1)
      for (int step = 0; step < kMostNewton; ++step)
        if (stop_.stop_requested() || !newton(mu)) break;
  }

  /// One damped Newton step for distance + mu barrier; returns false when the iteration is
  /// finished.
  bool newton(double mu) {
    const VectorXd y = t_.apply(x_);
    const Index m = t_.elements();
    std::vector<Eigen::Matrix4d> blocks;
    std::vector<FrameBarrier> barriers;
    VectorXd pull(4 * m);
    for (Index i = 0; i < m; ++i) {
      barriers.push_back(barrier(y, i));
      const FrameBarrier& b = barriers.back();
      // Eliminate r using its own row of the system.
      const Eigen::Vector4d mixed = b.hessian.col(4).head<4>();
      const double rr = b.hessian(4, 4);
      blocks.push_back(mu * (b.hessian.topLeftCorner<4, 4>() - mixed * mixed.transpose() / rr));
      blocks.back().diagonal().array() += t_.weights()[i];
      pull.segment<4>(4 * i) = t_.weights()[i] * (y - g_).segment<4>(4 * i) +
                               mu * (b.gradient.head<4>() - mixed * b.gradient[4] / rr);
    }
    t_.factor(blocks);
    const VectorXd dx = t_.solve(-t_.adjoint(pull)), dy = t_.apply(dx);
    VectorXd dr(m);
    double slope = pull.dot(dy);
    for (Index i = 0; i < m; ++i) {
      const FrameBarrier& b = barriers[static_cast<size_t>(i)];
      dr[i] =
          -(b.gradient[4] + b.hessian.col(4).head<4>().dot(dy.segment<4>(4 * i))) / b.hessian(4, 4);
      slope -= mu * b.gradient[4] * b.gradient[4] / b.hessian(4, 4);
    }
    const double current = distance(y) + mu * barrier_value(y, r_);
    if (!std::isfinite(current) || !dx.allFinite()) return false;
    double length = 1;
    for (int halving = 0; halving < 40; ++halving, length *= 0.5) {
      const VectorXd r = r_ + length * dr, moved = y + length * dy;
      if (distance(moved) + mu * barrier_value(moved, r) > current + 0.1 * length * slope) continue;
      x_ += length * dx;
      r_ = r;
      constexpr double kCentered = 1e-2;  // squared Newton decrement, in units of mu
      return -slope > kCentered * mu;
    }
    return false;
  }

  DerivativeOperator& t_;
  const VectorXd& g_;
  Bounds bounds_;
  const std::stop_token& stop_;
  std::vector<Complex> frames_;
  VectorXd x_, r_;
};

}  // namespace

Projected by_local_frames(DerivativeOperator& t, const VectorXd& g,
                          const ProjectionSettings& settings) {
  return LocalFrames(t, g, settings).run();
}

}  // namespace holomorph
