// The slacks are linear in x, except for the heights, which are recomputed after each step.
#include "core/solvers/cone_program.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.h"
#include "core/solvers/cone.h"

namespace holomorph {
namespace {

/// A curved slack that is nearly zero forces short steps. After a step shorter than kShort, the
/// next step moves back toward the central path.
constexpr double kShort = 0.3, kRecenter = 0.5;

class Solver {
 public:
  Solver(const ConeSystem& system, const ConeTarget& target, const ConeSettings& settings,
         const ConeSolution& start)
      : system_(system),
        target_(target),
        settings_(settings),
        p_(system.height.rows()),
        q_(system.re.rows()),
        m_(system.samples()),
        k_(system.fit.cols()),
        at_(start) {
    at_.status = ConeSolution::Status::stopped;
    check(at_.x.size() == p_ + q_ && target.linear.size() == p_ + q_ && target.wanted.size() == k_,
          "cone program: sizes agree");
    s_.resize(system.cones.size());
    u_ = heights(at_.x);
    push(at_.x, s_);
    check(set_heights(u_, s_), "cone program: the start is strictly feasible");
    center_duals();
    start_fit(start.fit_duals.size() == k_);
    scalings_.assign(s_.size(), std::vector<Scaling>(static_cast<size_t>(m_)));
  }

  ConeSolution run() {
    for (at_.iterations = 0;; ++at_.iterations) {
      update_gradient();
      measure();
      if (at_.gap <= std::max(settings_.gap, settings_.relative_gap * at_.energy) &&
          at_.residual <= settings_.residual) {
        at_.status = ConeSolution::Status::solved;
        break;
      }
      if (at_.iterations == settings_.iterations) break;
      if (step()) continue;
      if (precise_) break;
      precise_ = true;
    }
    at_.fit_duals = (up_.z - down_.z) / system_.fit_weight;
    return std::move(at_);
  }

 private:
  VectorXd heights(const VectorXd& x) const {
    return p_ > 0 ? transposed_product(system_.height, x.head(p_)) : VectorXd::Zero(m_);
  }

  /// Sets the heights of the slacks for the given u. Returns false if a slack is not strictly
  /// inside its cone.
  bool set_heights(const VectorXd& u, std::vector<Eigen::Matrix3Xd>& s) {
    decay_ = (-u.array()).exp();
    bool inside = true;
    for (size_t c = 0; c < s.size(); ++c)
      for (Index i = 0; i < m_; ++i) {
        s[c](0, i) = system_.cones[c].height(i, u[i], decay_[i]);
        inside = inside && is_inside(s[c].col(i));
      }
    return inside;
  }

  double slope_at(const Cone& cone, Index i) const {
    return cone.slope + (cone.decay > 0 ? cone.decay * decay_[i] : 0);
  }

  /// Sets missing multipliers to z = mu s^-1. mu is the mean over the known multipliers or, if
  /// there are none, follows from settings.first_gap.
  void center_duals() {
    if (at_.z.size() != s_.size()) at_.z.assign(s_.size(), Eigen::Matrix3Xd(3, 0));
    const Index known = std::min(at_.z.empty() ? 0 : at_.z[0].cols(), m_);
    double mu = settings_.first_gap / static_cast<double>(std::max<Index>(m_, 1));
    if (known > 0) {
      mu = 0;
      for (size_t c = 0; c < s_.size(); ++c)
        mu += s_[c].leftCols(known).cwiseProduct(at_.z[c].leftCols(known)).sum();
      mu /= static_cast<double>(known) * static_cast<double>(s_.size());
    }
    for (size_t c = 0; c < s_.size(); ++c) {
      at_.z[c].conservativeResize(3, m_);
      for (Index i = known; i < m_; ++i)
        at_.z[c].col(i) = mu / det(s_[c].col(i)) * reflected(s_[c].col(i));
    }
  }

  /// Sum over the cones of J' v.
  VectorXd pulled_back(const std::vector<Eigen::Matrix3Xd>& v) const {
    VectorXd u = VectorXd::Zero(m_), re = u, im = u, result(p_ + q_);
    for (size_t c = 0; c < v.size(); ++c)
      for (Index i = 0; i < m_; ++i) {
        u[i] += slope_at(system_.cones[c], i) * v[c](0, i);
        re[i] += v[c](1, i);
        im[i] += v[c](2, i);
      }
    if (p_ > 0) result.head(p_) = product(system_.height, u);
    if (q_ > 0) result.tail(q_) = product(system_.re, re) + product(system_.im, im);
    return result;
  }

  /// One side of |r| <= t: the slacks t - r or t + r, the multipliers, and the directions of slacks
  /// and multipliers.
  struct Side {
    VectorXd s, z, ds, dz;
  };

  void start_fit(bool warm) {
    const VectorXd residual = fit_residual(at_.x);
    constexpr double kRoom = 0.1;  // between |r| and its bound
    const double room = std::max(kRoom, k_ > 0 ? residual.cwiseAbs().mean() : 0.0);
    const VectorXd t = residual.cwiseAbs().array() + (warm ? 0.1 * kRoom : room);
    up_.s = t - residual;
    down_.s = t + residual;
    constexpr double kSurest = 0.95;
    const VectorXd d =
        warm ? VectorXd(at_.fit_duals.cwiseMax(-kSurest).cwiseMin(kSurest)) : VectorXd::Zero(k_);
    up_.z = 0.5 * system_.fit_weight * (1 + d.array());
    down_.z = 0.5 * system_.fit_weight * (1 - d.array());
  }

  VectorXd fit_residual(const VectorXd& x) const {
    return k_ > 0 ? VectorXd(transposed_product(system_.fit, x.head(p_)) - target_.wanted)
                  : VectorXd();
  }

  void update_gradient() { gradient_ = system_.quadratic * at_.x + target_.linear; }

  /// Adds the fit's part of the right-hand side. `up` and `down` are (the right-hand side of the
  /// complementarity) / s - z.
  void add_fit_right(const VectorXd& up, const VectorXd& down, VectorXd& right) const {
    if (k_ == 0) return;
    const Eigen::ArrayXd du = up_.z.array() / up_.s.array(), dd = down_.z.array() / down_.s.array();
    const VectorXd pull =
        (up_.z - down_.z).array() + 2 * (up.array() * dd - down.array() * du) / (du + dd);
    right.head(p_) -= product(system_.fit, pull);
  }

  /// Computes the directions of both sides from the direction of the residuals. t is free. The sum
  /// up.z + down.z is constant.
  void push_fit(const VectorXd& dx, const VectorXd& up, const VectorXd& down) {
    if (k_ == 0) return;
    const Eigen::ArrayXd du = up_.z.array() / up_.s.array(), dd = down_.z.array() / down_.s.array(),
                         dr = transposed_product(system_.fit, dx.head(p_)).array(),
                         dt = (up.array() + down.array() + (du - dd) * dr) / (du + dd);
    up_.ds = dt - dr;
    down_.ds = dt + dr;
    up_.dz = up.array() - du * (dt - dr);
    down_.dz = -up_.dz;
  }

  void measure() {
    at_.gap = 0;
    for (size_t c = 0; c < s_.size(); ++c) at_.gap += s_[c].cwiseProduct(at_.z[c]).sum();
    at_.gap += up_.s.dot(up_.z) + down_.s.dot(down_.z);
    VectorXd lagrangian = gradient_ - pulled_back(at_.z);
    if (k_ > 0) lagrangian.head(p_) += product(system_.fit, up_.z - down_.z);
    at_.residual = lagrangian.norm();
    at_.energy = 0.5 * at_.x.dot(gradient_ + target_.linear) + target_.constant;
    if (k_ > 0) at_.energy += 0.5 * system_.fit_weight * (up_.s - down_.s).lpNorm<1>();
  }

  /// Computes the lower triangle of the normal matrix. Far from the solution, single precision
  /// suffices: slightly inexact steps still make progress, and the residual is computed in double
  /// precision.
  void assemble() {
    for (size_t c = 0; c < s_.size(); ++c)
      for (Index i = 0; i < m_; ++i)
        scalings_[c][static_cast<size_t>(i)] = Scaling(s_[c].col(i), at_.z[c].col(i));
    normal_ = system_.quadratic;
    constexpr double kFar = 1e-5;  // the smallest gap for single precision
    precise_ = precise_ || at_.gap < kFar;
    if (precise_)
      add_curvature(double_);
    else
      add_curvature(single_);
  }

  /// The columns to multiply, and the sum of their products.
  template <class Scalar>
  struct Workspace {
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    Matrix a, b, ab, sum;
  };

  template <class Scalar>
  void add_curvature(Workspace<Scalar>& work) {
    work.a.resize(p_, std::max(m_, k_));
    work.b.resize(q_, 2 * m_);
    work.ab.resize(q_, m_);
    work.sum.setZero(p_ + q_, p_ + q_);
    add_fit(work);
    add_barrier(work);
    normal_ += work.sum.template cast<double>();
  }

  /// The curvature of |r| along the central path: 4 / (sum of s / z over both sides).
  template <class Scalar>
  void add_fit(Workspace<Scalar>& work) {
    for (Index i = 0; i < k_; ++i) {
      const double weight = 4 / (up_.s[i] / up_.z[i] + down_.s[i] / down_.z[i]);
      work.a.col(i) = (std::sqrt(weight) * system_.fit.col(i)).template cast<Scalar>();
    }
    add_gram(work.a, k_, 0, work.sum);
  }

  /// The curvature of the barriers of a sample with respect to (u, w).
  Eigen::Matrix3d barrier_at(Index i) const {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    for (size_t c = 0; c < s_.size(); ++c) {
      const Cone& cone = system_.cones[c];
      Eigen::Matrix3d part = scalings_[c][static_cast<size_t>(i)].inverse_square();
      const double slope = slope_at(cone, i);
      part.row(0) *= slope;
      part.col(0) *= slope;
      h += part;
      if (cone.decay > 0) h(0, 0) += cone.decay * decay_[i] * at_.z[c](0, i);
    }
    return h;
  }

  template <class Scalar>
  void add_barrier(Workspace<Scalar>& work) {
    Index used = 0;  // a: sqrt(uu) height; b: Cholesky of ww; ab: the mixed block over sqrt(uu)
    for (Index i = 0; i < m_; ++i) {
      const Eigen::Matrix3d h = barrier_at(i);
      if (h.trace() * static_cast<double>(m_) < settings_.neglected) continue;
      const double root = std::sqrt(h(0, 0));
      if (p_ > 0) work.a.col(used) = (root * system_.height.col(i)).template cast<Scalar>();
      if (q_ > 0) {
        const auto re = system_.re.col(i), im = system_.im.col(i);
        const double l = std::sqrt(h(1, 1)), m = h(2, 1) / l,
                     n = std::sqrt(std::max(h(2, 2) - m * m, 0.0));
        work.b.col(2 * used) = (l * re + m * im).template cast<Scalar>();
        work.b.col(2 * used + 1) = (n * im).template cast<Scalar>();
        if (p_ > 0 && root > 0)
          work.ab.col(used) = (h(1, 0) / root * re + h(2, 0) / root * im).template cast<Scalar>();
      }
      ++used;
    }
    add_gram(work.a, used, 0, work.sum);
    add_gram(work.b, 2 * used, p_, work.sum);
    if (p_ > 0 && q_ > 0) add_product(work.ab, work.a, used, p_, 0, work.sum);
  }

  /// Computes the linear parts of the slack directions along dx: du_ for u, and the w rows of `ds`
  /// for all cones.
  void push(const VectorXd& dx, std::vector<Eigen::Matrix3Xd>& ds) {
    du_ = heights(dx);
    VectorXd re = VectorXd::Zero(m_), im = re;
    if (q_ > 0) {
      re = transposed_product(system_.re, dx.tail(q_));
      im = transposed_product(system_.im, dx.tail(q_));
    }
    ds.resize(s_.size());
    for (size_t c = 0; c < ds.size(); ++c) {
      ds[c].resize(3, m_);
      ds[c].row(1) = re.transpose();
      ds[c].row(2) = im.transpose();
    }
  }
  /// The directions of the slacks along dx.
  void push_slacks(const VectorXd& dx) {
    push(dx, ds_);
    for (size_t c = 0; c < ds_.size(); ++c)
      for (Index i = 0; i < m_; ++i) ds_[c](0, i) = slope_at(system_.cones[c], i) * du_[i];
  }

  /// dz = t - z - W^-2 ds, where t is 0 if null.
  void dual_step(const std::vector<Eigen::Matrix3Xd>& ds, const std::vector<Eigen::Matrix3Xd>* t,
                 std::vector<Eigen::Matrix3Xd>& dz) const {
    dz.resize(s_.size());
    for (size_t c = 0; c < dz.size(); ++c) {
      dz[c].resize(3, m_);
      for (Index i = 0; i < m_; ++i) {
        const Scaling& scaling = scalings_[c][static_cast<size_t>(i)];
        dz[c].col(i) = -at_.z[c].col(i) - scaling.undo(scaling.undo(ds[c].col(i)));
        if (t) dz[c].col(i) += (*t)[c].col(i);
      }
    }
  }

  double longest_step(const std::vector<Eigen::Matrix3Xd>& ds,
                      const std::vector<Eigen::Matrix3Xd>& dz) const {
    double step = 1 / 0.98;
    for (size_t c = 0; c < s_.size(); ++c)
      for (Index i = 0; i < m_; ++i)
        step = std::min({step, step_to_boundary(s_[c].col(i), ds[c].col(i)),
                         step_to_boundary(at_.z[c].col(i), dz[c].col(i))});
    for (const Side* side : {&up_, &down_})
      for (Index i = 0; i < k_; ++i) {
        if (side->ds[i] < 0) step = std::min(step, -side->s[i] / side->ds[i]);
        if (side->dz[i] < 0) step = std::min(step, -side->z[i] / side->dz[i]);
      }
    return step;
  }

  bool step() {
    assemble();
    if (!cholesky_.factor(normal_)) {
      const double ridge = 1e-10 * normal_.diagonal().maxCoeff();
      normal_.diagonal().array() += ridge;
      if (!cholesky_.factor(normal_)) return false;
    }
    const double count = static_cast<double>(m_ * static_cast<Index>(s_.size()) + 2 * k_);
    const double mu = at_.gap / std::max(count, 1.0);
    VectorXd up = -up_.z, down = -down_.z, right = -gradient_;
    add_fit_right(up, down, right);
    VectorXd dx = cholesky_.solve(right);
    push_slacks(dx);
    push_fit(dx, up, down);
    dual_step(ds_, nullptr, dz_);
    const double reach = std::min(1.0, longest_step(ds_, dz_));
    double later = 0;
    for (size_t c = 0; c < s_.size(); ++c)
      later += (s_[c] + reach * ds_[c]).cwiseProduct(at_.z[c] + reach * dz_[c]).sum();
    for (const Side* side : {&up_, &down_})
      if (k_ > 0) later += (side->s + reach * side->ds).dot(side->z + reach * side->dz);
    double center = std::pow(std::clamp(later / at_.gap, 0.0, 1.0), 3);
    if (length_ < kShort) center = std::max(center, kRecenter);
    for (size_t c = 0; c < s_.size(); ++c)
      for (Index i = 0; i < m_; ++i) {
        const Scaling& scaling = scalings_[c][static_cast<size_t>(i)];
        const Cone3 lambda = scaling.apply(at_.z[c].col(i));
        Cone3 corrected = -jordan(scaling.undo(ds_[c].col(i)), scaling.apply(dz_[c].col(i)));
        corrected[0] += center * mu;
        dz_[c].col(i) = scaling.undo(divided(lambda, corrected));
      }
    const auto corrected = [&](const Side& side) -> VectorXd {
      return (center * mu - side.ds.array() * side.dz.array()) / side.s.array() - side.z.array();
    };
    if (k_ > 0) up = corrected(up_), down = corrected(down_);
    const std::vector<Eigen::Matrix3Xd> t = dz_;
    right = pulled_back(t) - gradient_;
    add_fit_right(up, down, right);
    dx = cholesky_.solve(right);
    push_slacks(dx);
    push_fit(dx, up, down);
    dual_step(ds_, &t, dz_);
    return move(dx, 0.98 * longest_step(ds_, dz_));
  }

  /// Moves along dx by at most `length`, as far as the exact slacks allow. Returns false if it
  /// cannot move.
  bool move(const VectorXd& dx, double length) {
    std::vector<Eigen::Matrix3Xd> slacks(s_.size());
    VectorXd u;
    const auto is_good = [&] {
      u = u_ + length * du_;
      for (size_t c = 0; c < s_.size(); ++c) slacks[c] = s_[c] + length * ds_[c];
      if (!set_heights(u, slacks)) return false;
      for (size_t c = 0; c < s_.size(); ++c)
        for (Index i = 0; i < m_; ++i)
          if (det(slacks[c].col(i)) < 1e-4 * det(s_[c].col(i))) return false;
      return true;
    };
    int tries = 0;
    constexpr int kMostTries = 60;
    while (tries < kMostTries && !is_good()) length *= 0.8, ++tries;
    if (tries == kMostTries || !dx.allFinite()) {
      set_heights(u_, s_);
      return false;
    }
    length_ = length;
    at_.x += length * dx;
    u_ = std::move(u);
    s_ = std::move(slacks);
    for (size_t c = 0; c < s_.size(); ++c) at_.z[c] += length * dz_[c];
    for (Side* side : {&up_, &down_})
      if (k_ > 0) side->s += length * side->ds, side->z += length * side->dz;
    return true;
  }

  const ConeSystem& system_;
  const ConeTarget& target_;
  const ConeSettings& settings_;
  Index p_, q_, m_, k_;
  ConeSolution at_;
  Side up_, down_;
  double length_ = 1;  ///< length of the last step
  std::vector<Eigen::Matrix3Xd> s_, ds_, dz_;
  std::vector<std::vector<Scaling>> scalings_;
  VectorXd u_, du_, decay_, gradient_;
  bool precise_ = false;  ///< whether double precision has taken over
  MatrixXd normal_;
  Workspace<float> single_;
  Workspace<double> double_;
  Cholesky cholesky_;
};

}  // namespace

bool is_feasible(const ConeSystem& system, const VectorXd& x) {
  // Uses the same sums as the solver, to agree with it to the last bit.
  const Index p = system.height.rows(), q = system.re.rows(), m = system.samples();
  VectorXd u = VectorXd::Zero(m), re = u, im = u;
  if (p > 0) u = transposed_product(system.height, x.head(p));
  if (q > 0) {
    re = transposed_product(system.re, x.tail(q));
    im = transposed_product(system.im, x.tail(q));
  }
  for (Index i = 0; i < m; ++i)
    for (const Cone& cone : system.cones)
      if (!is_inside({cone.height(i, u[i], std::exp(-u[i])), re[i], im[i]})) return false;
  return true;
}

double energy_of(const ConeSystem& system, const ConeTarget& target, const VectorXd& x) {
  double energy = 0.5 * x.dot(system.quadratic * x) + target.linear.dot(x) + target.constant;
  if (system.fit.cols() > 0)
    energy += system.fit_weight *
              (system.fit.transpose() * x.head(system.height.rows()) - target.wanted).lpNorm<1>();
  return energy;
}

ConeSolution solved(const ConeSystem& system, const ConeTarget& target,
                    const ConeSettings& settings, const ConeSolution& start) {
  return Solver(system, target, settings, start).run();
}

}  // namespace holomorph
