// Newton's method. A step goes at most 0.9 of the way to |nu| = 1, then is halved until the value
// decreases. One correction for the curvature of the stations uses the same factorization.
#include "core/isometric/isometric_program.h"

#include <algorithm>
#include <utility>

#include "core/arithmetic.h"
#include "core/error.h"
#include "core/isometric/pin_curvature.h"
#include "core/solvers/factors.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

/// The values of a program at x.
struct State {
  VectorXd x;
  VectorXd u, a, b;   ///< Re l, Re nu and Im nu at samples
  VectorXc phi, psi;  ///< weight * e^l and weight * nu e^l at the nodes of the paths
  VectorXc grown;     ///< weight * (e^l - 1)
  VectorXc offsets;   ///< c
  VectorXc gaps;      ///< g
  Complex move;
  VectorXc l_off, nu_off;  ///< deviations of l and nu at the frames
  double energy = 0, barrier = 0, total = 0;
};

class IsometricSolver {
 public:
  IsometricSolver(const IsometricSystem& system, const IsometricTarget& target,
                  const IsometricSettings& settings)
      : system_(system), target_(target), settings_(settings), n_(system.size()) {
    check(target.stations.size() == system.station_weights.size() &&
              target.frames.size() == system.frames.rows(),
          "isometric program: sizes agree");
    check(!system.barrier || settings.barrier > 0, "isometric program: the barrier has a weight");
    all_ = system.station_weights.sum();
  }

  /// The values at x; the total is infinite if |nu| >= 1 at a sample.
  State at(VectorXd x) const {
    State s;
    s.x = std::move(x);
    const auto l = s.x.head(2 * n_), nu = s.x.tail(2 * n_);
    s.u = transposed_product(system_.re, l);
    s.a = transposed_product(system_.re, nu);
    s.b = transposed_product(system_.im, nu);
    const Index m = s.u.size();
    for (Index i = 0; i < m; ++i) {
      if (!(s.a[i] * s.a[i] + s.b[i] * s.b[i] < 1)) {
        s.total = std::numeric_limits<double>::infinity();
        return s;
      }
      s.energy += system_.weights[i] * system_.energy.value(s.u[i], s.a[i], s.b[i]);
      if (system_.barrier)
        s.barrier +=
            settings_.barrier * system_.weights[i] * system_.barrier->value(s.u[i], s.a[i], s.b[i]);
    }
    s.total = s.energy + s.barrier;
    if (std::isinf(s.total)) return s;
    const VectorXc xl = complex_of(l), xnu = complex_of(nu);
    if (has_paths()) {
      MatrixXc both(n_, 2);
      both << xl, xnu;
      const MatrixXc at_nodes = matrix_product(system_.nodes, both);
      s.grown = at_nodes.col(0).unaryExpr([](Complex l) { return exp_minus_one(l); });
      s.phi = system_.paths.weights().cwiseProduct((s.grown.array() + 1).matrix());
      s.grown = s.grown.cwiseProduct(system_.paths.weights()).eval();
      s.psi = s.phi.cwiseProduct(at_nodes.col(1));
      set_offsets(s);
      for (Index j = 0; j < s.offsets.size(); ++j)
        s.total += settings_.penalty * system_.station_weights[j] * std::norm(s.offsets[j]);
      s.total += system_.closing * s.gaps.squaredNorm();
    }
    if (target_.frames.size() > 0) {
      s.l_off = system_.frames * xl - target_.frames;
      s.nu_off = system_.frames * xnu;
      for (Index k = 0; k < s.l_off.size(); ++k)
        s.total += system_.frame_weights[k] * (std::norm(s.l_off[k]) + std::norm(s.nu_off[k]));
    }
    if (!std::isfinite(s.total)) s.total = std::numeric_limits<double>::infinity();
    return s;
  }

  /// Sets the gradient and the lower triangle of the matrix at a state.
  void linearize(const State& s) {
    const Index N = system_.unknowns();
    gradient_.setZero(N);
    hessian_.setZero(N, N);
    add_energy(s);
    if (has_paths()) add_paths(s);
    if (target_.frames.size() > 0) add_frames(s);
    hessian_.diagonal().array() += kRidge;
  }

  IsometricSolution run(VectorXd start) {
    State s = at(std::move(start));
    check(std::isfinite(s.total), "isometric program: the start is inside");
    IsometricSolution out;
    for (; out.iterations < settings_.iterations; ++out.iterations) {
      throw_if_stopped(settings_.stop);
      linearize(s);
      if (!factor(s)) break;
      const VectorXd d = -cholesky_.solve(gradient_);
      const double slope = gradient_.dot(d);
      if (-slope <= settings_.tolerance * s.total) {
        out.converged = true;
        break;
      }
      near_ = -slope <= kNear * s.total;
      if (!advance(d, slope, s)) {
        out.converged = true;  // rounding prevents any further decrease
        break;
      }
      curved_ = curved_ || (near_ && step_ < 1);
    }
    report(s, out);
    return out;
  }

  /// The smallest changes that close the gaps, until they are `small`.
  IsometricSolution closed(VectorXd start, double small) {
    State s = at(std::move(start));
    check(std::isfinite(s.total), "isometric program: the start is inside");
    constexpr int kSteps = 8;
    for (int step = 0; step < kSteps && s.gaps.cwiseAbs().maxCoeff() > small; ++step) {
      set_rows(s);
      const Index count = 2 * s.gaps.size();
      const MatrixXd rows = rows_.rightCols(count);
      const VectorXd d = -rows * solve_symmetric(rows.transpose() * rows, scaled(s).tail(count));
      double part = longest_step(s, d);
      State next = at(s.x + part * d);
      constexpr double kShortest = 1e-3;
      const auto is_better = [&] {
        return std::isfinite(next.total) && next.gaps.norm() < s.gaps.norm();
      };
      for (; !is_better() && part > kShortest; part *= 0.5) next = at(s.x + 0.5 * part * d);
      if (!is_better()) break;
      s = std::move(next);
    }
    IsometricSolution out;
    report(s, out);
    return out;
  }

  IsometricDerivatives derivatives(const VectorXd& x) {
    const State s = at(x);
    linearize(s);
    return {s.total, gradient_, hessian_};
  }

 private:
  static constexpr double kRidge = 1e-9;
  static constexpr double kNear = 1e-2;  ///< a relative decrement

  void report(const State& s, IsometricSolution& out) const {
    out.x = s.x;
    out.step = step_;
    out.offsets = s.offsets;
    out.gaps = s.gaps;
    out.move = s.move;
    out.energy = s.energy / system_.weights.sum();
    out.total = s.total;
    out.barrier = s.barrier;
  }

  bool has_paths() const { return target_.stations.size() > 0 || !system_.paths.loops().empty(); }

  void set_offsets(State& s) const {
    const auto& pieces = system_.paths.pieces();
    constexpr Index kNodes = PathTree::kNodes;
    std::vector<Complex> f(pieces.size());
    for (size_t e = 0; e < pieces.size(); ++e) {
      const Index first = static_cast<Index>(e) * kNodes;
      f[e] = s.grown.segment(first, kNodes).sum() + std::conj(s.psi.segment(first, kNodes).sum());
      if (pieces[e].parent >= 0) f[e] += f[static_cast<size_t>(pieces[e].parent)];
    }
    const std::vector<Index>& loops = system_.paths.loops();
    s.gaps.resize(static_cast<Index>(loops.size()));
    for (size_t h = 0; h < loops.size(); ++h)
      s.gaps[static_cast<Index>(h)] = f[static_cast<size_t>(loops[h])];
    const std::vector<Index>& ends = system_.paths.ends();
    s.offsets.resize(static_cast<Index>(ends.size()));
    if (ends.empty()) return;
    Complex mean = 0;
    for (size_t j = 0; j < ends.size(); ++j) {
      const Index i = static_cast<Index>(j);
      s.offsets[i] = (ends[j] >= 0 ? f[static_cast<size_t>(ends[j])] : 0) - target_.stations[i];
      mean += system_.station_weights[i] * s.offsets[i];
    }
    mean /= all_;
    s.offsets.array() -= mean;
    s.move = -mean;
  }

  void add_energy(const State& s) {
    if (settings_.single)
      add_energy(s, single_);
    else
      add_energy(s, double_);
  }

  template <class Scalar>
  struct Workspace {
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    Matrix u, nu, mixed, sum;
  };

  template <class Scalar>
  void add_energy(const State& s, Workspace<Scalar>& work) {
    const Index m = s.u.size(), rows = 2 * n_;
    work.u.resize(rows, m);
    work.nu.resize(rows, 2 * m);
    work.mixed.resize(rows, m);
    VectorXd gu(m), ga(m), gb(m);
    for (Index i = 0; i < m; ++i) {
      auto e = system_.energy.with_derivatives(s.u[i], s.a[i], s.b[i]);
      if (system_.barrier) system_.barrier->add_to(e, settings_.barrier, s.u[i], s.a[i], s.b[i]);
      const double w = system_.weights[i];
      gu[i] = w * e.gradient[0];
      ga[i] = w * e.gradient[1];
      gb[i] = w * e.gradient[2];
      // The columns' Gram matrices are the blocks of w h.
      const Eigen::Matrix3d h = w * e.hessian;
      const auto re = system_.re.col(i), im = system_.im.col(i);
      const double root = std::sqrt(h(0, 0)), p = std::sqrt(h(1, 1)), q = h(2, 1) / p,
                   r = std::sqrt(std::max(h(2, 2) - q * q, 0.0));
      work.u.col(i) = (root * re).template cast<Scalar>();
      work.mixed.col(i) = (h(1, 0) / root * re + h(2, 0) / root * im).template cast<Scalar>();
      work.nu.col(2 * i) = (p * re + q * im).template cast<Scalar>();
      work.nu.col(2 * i + 1) = (r * im).template cast<Scalar>();
    }
    gradient_.head(rows) += product(system_.re, gu);
    gradient_.tail(rows) += product(system_.re, ga) + product(system_.im, gb);
    work.sum.setZero(2 * rows, 2 * rows);
    add_gram(work.u, m, 0, work.sum);
    add_gram(work.nu, 2 * m, rows, work.sum);
    add_product(work.mixed, work.u, m, rows, 0, work.sum);
    hessian_ += work.sum.template cast<double>();
  }

  /// Sets the rows of J: 4n x 2 (stations + loops), real and imaginary parts of sqrt(penalty s) c,
  /// and of sqrt(closing) g.
  void set_rows(const State& s) {
    const auto& pieces = system_.paths.pieces();
    const Index count = static_cast<Index>(pieces.size());
    constexpr Index kNodes = PathTree::kNodes;
    // Derivatives of the integrals of e^l and nu e^l with respect to l; the first is also that of
    // the second with respect to nu.
    PlanarMatrix<double> phi(n_, count), psi(n_, count);
    const auto add = [](Complex factor, const auto& re, const auto& im, Index e,
                        PlanarMatrix<double>& to) {
      to.re.col(e) += factor.real() * re - factor.imag() * im;
      to.im.col(e) += factor.real() * im + factor.imag() * re;
    };
    for (Index e = 0; e < count; ++e) {
      for (PlanarMatrix<double>* sum : {&phi, &psi}) {
        const Index parent = pieces[static_cast<size_t>(e)].parent;
        sum->re.col(e) = parent >= 0 ? VectorXd(sum->re.col(parent)) : VectorXd::Zero(n_);
        sum->im.col(e) = parent >= 0 ? VectorXd(sum->im.col(parent)) : VectorXd::Zero(n_);
      }
      for (Index k = e * kNodes; k < (e + 1) * kNodes; ++k) {
        const auto re = system_.nodes_by_column.re.col(k), im = system_.nodes_by_column.im.col(k);
        add(s.phi[k], re, im, e, phi);
        add(s.psi[k], re, im, e, psi);
      }
    }
    std::vector<Index> ends = system_.paths.ends();
    const Index stations = static_cast<Index>(ends.size());
    ends.insert(ends.end(), system_.paths.loops().begin(), system_.paths.loops().end());
    const Index all = static_cast<Index>(ends.size());
    rows_.setZero(4 * n_, 2 * all);
    for (Index j = 0; j < all; ++j) {
      const Index end = ends[static_cast<size_t>(j)];
      if (end < 0) continue;
      auto re = rows_.col(2 * j), im = rows_.col(2 * j + 1);
      re.segment(0, n_) = phi.re.col(end) + psi.re.col(end);
      re.segment(n_, n_) = -phi.im.col(end) - psi.im.col(end);
      re.segment(2 * n_, n_) = phi.re.col(end);
      re.segment(3 * n_, n_) = -phi.im.col(end);
      im.segment(0, n_) = phi.im.col(end) - psi.im.col(end);
      im.segment(n_, n_) = phi.re.col(end) - psi.re.col(end);
      im.segment(2 * n_, n_) = -phi.im.col(end);
      im.segment(3 * n_, n_) = -phi.re.col(end);
    }
    VectorXd mean_re = VectorXd::Zero(4 * n_), mean_im = mean_re;
    for (Index j = 0; j < stations; ++j) {
      mean_re += system_.station_weights[j] / all_ * rows_.col(2 * j);
      mean_im += system_.station_weights[j] / all_ * rows_.col(2 * j + 1);
    }
    for (Index j = 0; j < stations; ++j) {
      const double scale = std::sqrt(settings_.penalty * system_.station_weights[j]);
      rows_.col(2 * j) = scale * (rows_.col(2 * j) - mean_re);
      rows_.col(2 * j + 1) = scale * (rows_.col(2 * j + 1) - mean_im);
    }
    rows_.rightCols(2 * (all - stations)) *= std::sqrt(system_.closing);
  }

  /// sqrt(penalty s) c and sqrt(closing) g as real numbers, in the order of the rows.
  VectorXd scaled(const State& s) const {
    const Index stations = s.offsets.size();
    VectorXd real(2 * (stations + s.gaps.size()));
    for (Index j = 0; j < stations; ++j) {
      const double scale = std::sqrt(settings_.penalty * system_.station_weights[j]);
      real[2 * j] = scale * s.offsets[j].real();
      real[2 * j + 1] = scale * s.offsets[j].imag();
    }
    for (Index h = 0; h < s.gaps.size(); ++h) {
      real[2 * (stations + h)] = std::sqrt(system_.closing) * s.gaps[h].real();
      real[2 * (stations + h) + 1] = std::sqrt(system_.closing) * s.gaps[h].imag();
    }
    return real;
  }

  void add_paths(const State& s) {
    set_rows(s);
    gradient_ += 2 * product(rows_, scaled(s));
    const MatrixXd columns = std::sqrt(2.0) * rows_;
    add_gram(columns, columns.cols(), 0, hessian_);
  }

  void add_frames(const State& s) {
    for (Index k = 0; k < s.l_off.size(); ++k) {
      const double weight = system_.frame_weights[k];
      MatrixXd columns = MatrixXd::Zero(4 * n_, 4);
      MatrixXd re, im;
      real_columns(system_.frames.row(k), re, im);
      columns.col(0).head(2 * n_) = re;
      columns.col(1).head(2 * n_) = im;
      columns.col(2).tail(2 * n_) = re;
      columns.col(3).tail(2 * n_) = im;
      const Eigen::Vector4d off(s.l_off[k].real(), s.l_off[k].imag(), s.nu_off[k].real(),
                                s.nu_off[k].imag());
      gradient_ += 2 * weight * (columns * off);
      columns *= std::sqrt(2 * weight);
      add_gram(columns, 4, 0, hessian_);
    }
  }

  /// Factors the matrix, with the second derivatives of pins that miss by far or where they shorten
  /// the steps. Near the minimum, they are exact if that is definite. Otherwise, their convex part
  /// is used, less as much of the concave part as possible: the more of it, the longer the steps
  /// are.
  bool factor(const State& s) {
    if (!hessian_.allFinite()) return false;
    const bool is_far = s.offsets.size() > 0 && s.offsets.cwiseAbs().maxCoeff() > settings_.far;
    if (std::isinf(settings_.far) || !(is_far || curved_)) return factor();
    const PinCurvature pins(system_, s.phi, s.psi, settings_.penalty, s.offsets);
    if (!near_) {
      hessian_ += pins.convex_part();
      return factor();
    }
    const MatrixXd exact = pins.second_derivatives();
    if (cholesky_.factor(hessian_ + exact)) return true;
    const MatrixXd convex = pins.convex_part();
    for (const double part : {0.9, 0.7, 0.4})
      if (cholesky_.factor(hessian_ + (1 - part) * convex + part * exact)) return true;
    hessian_ += convex;
    return factor();
  }

  bool factor() {
    double ridge = 1e-12 * hessian_.diagonal().maxCoeff();
    for (int attempt = 0; attempt < 8; ++attempt, ridge *= 10) {
      if (cholesky_.factor(hessian_)) return true;
      hessian_.diagonal().array() += ridge;
    }
    return false;
  }

  /// The fraction of d that is 0.9 of the way to |nu| = 1 at a sample, but at most 1.
  double longest_step(const State& s, const VectorXd& d) const {
    const VectorXd a = transposed_product(system_.re, d.tail(2 * n_)),
                   b = transposed_product(system_.im, d.tail(2 * n_));
    double step = 1;
    constexpr double kShare = 0.9;
    for (Index i = 0; i < a.size(); ++i) {
      const double square = a[i] * a[i] + b[i] * b[i];
      if (square == 0) continue;
      const double half = s.a[i] * a[i] + s.b[i] * b[i],
                   room = 1 - s.a[i] * s.a[i] - s.b[i] * s.b[i];
      // The positive root t of square t^2 + 2 half t - room = 0.
      const double root = std::sqrt(half * half + square * room);
      const double t = half > 0 ? room / (half + root) : (root - half) / square;
      step = std::min(step, kShare * t);
    }
    return step;
  }

  /// Takes a step along d. Returns false if the value cannot be decreased.
  bool advance(const VectorXd& d, double slope, State& s) {
    constexpr double kArmijo = 1e-4, kShortest = 1e-10;
    const VectorXd along = has_paths() ? transposed_product(rows_, d) : VectorXd();
    for (double step = longest_step(s, d); step > kShortest; step *= 0.5) {
      State next = at(s.x + step * d);
      if (std::isfinite(next.total) && has_paths()) {
        const VectorXd bent = scaled(next) - scaled(s) - step * along;
        State better = at(next.x - 2 * cholesky_.solve(product(rows_, bent)));
        if (better.total < next.total) next = std::move(better);
      }
      if (next.total <= s.total + kArmijo * step * slope) {
        s = std::move(next);
        step_ = step;
        return true;
      }
    }
    return false;
  }

  const IsometricSystem& system_;
  const IsometricTarget& target_;
  const IsometricSettings& settings_;
  Index n_;
  double all_ = 0;  ///< sum of the stations' weights
  VectorXd gradient_;
  MatrixXd hessian_, rows_;
  bool near_ = false;    ///< the minimum
  bool curved_ = false;  ///< steps near the minimum were too long: the pins' curvature matters
  double step_ = 1;      ///< the part of the last Newton step that was taken
  Workspace<double> double_;
  Workspace<float> single_;
  Cholesky cholesky_;
};

}  // namespace

IsometricSolution minimized(const IsometricSystem& system, const IsometricTarget& target,
                            const IsometricSettings& settings, VectorXd start) {
  return IsometricSolver(system, target, settings).run(std::move(start));
}

IsometricSolution closed(const IsometricSystem& system, const IsometricTarget& target,
                         const IsometricSettings& settings, VectorXd x, double small) {
  return IsometricSolver(system, target, settings).closed(std::move(x), small);
}

bool is_inside(const IsometricSystem& system, const VectorXd& x) {
  const VectorXd u = transposed_product(system.re, x.head(2 * system.size())),
                 a = transposed_product(system.re, x.tail(2 * system.size())),
                 b = transposed_product(system.im, x.tail(2 * system.size()));
  for (Index i = 0; i < u.size(); ++i) {
    if (!(a[i] * a[i] + b[i] * b[i] < 1)) return false;
    if (!std::isfinite(system.energy.value(u[i], a[i], b[i]))) return false;
    if (system.barrier && std::isinf(system.barrier->value(u[i], a[i], b[i]))) return false;
  }
  return true;
}

double isometric_value(const IsometricSystem& system, const IsometricTarget& target,
                       const IsometricSettings& settings, const VectorXd& x) {
  return IsometricSolver(system, target, settings).at(x).total;
}

IsometricDerivatives isometric_derivatives(const IsometricSystem& system,
                                           const IsometricTarget& target,
                                           const IsometricSettings& settings, const VectorXd& x) {
  return IsometricSolver(system, target, settings).derivatives(x);
}

}  // namespace holomorph
