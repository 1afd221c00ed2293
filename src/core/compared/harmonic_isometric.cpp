#include "core/compared/harmonic_isometric.h"

#include "core/error.h"
#include "core/geometry/similarity.h"
#include "core/maps/argument.h"
#include "core/solvers/dense.h"
#include "core/solvers/factors.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// (x + y) (1 + 1 / (x - y)^2) with x = |f_z|^2 and y = |f_zbar|^2; infinite unless x > y.
double energy_of(Complex fz, Complex fzbar) {
  const double x = std::norm(fz), y = std::norm(fzbar), d = x - y;
  return d > 0 ? (x + y) * (1 + 1 / (d * d)) : std::numeric_limits<double>::infinity();
}

struct Local {
  Vector4 gradient;
  Matrix4 hessian;  ///< its positive part
};

/// Derivatives in (Re Phi', Im Phi', Re Psi', Im Psi').
Local local_at(Complex phi, Complex psi) {
  const double x = std::norm(phi), y = std::norm(psi), d = x - y;
  const double d2 = 1 / (d * d), d3 = d2 / d, d4 = d2 * d2, s = x + y;
  const double ex = 1 + d2 - 2 * s * d3, ey = 1 + d2 + 2 * s * d3;
  const double exx = -4 * d3 + 6 * s * d4, eyy = 4 * d3 + 6 * s * d4, exy = -6 * s * d4;
  const Vector4 a(phi.real(), phi.imag(), 0, 0), b(0, 0, psi.real(), psi.imag());
  Local local;
  local.gradient = 2 * ex * a + 2 * ey * b;
  Matrix4 h = 4 * (exx * a * a.transpose() + eyy * b * b.transpose() +
                   exy * (a * b.transpose() + b * a.transpose()));
  h.diagonal() += Vector4(2 * ex, 2 * ex, 2 * ey, 2 * ey);
  const Eigen4 eigen = eigen_decomposition(h);
  local.hessian = eigen.vectors * eigen.values.cwiseMax(0).asDiagonal() * eigen.vectors.transpose();
  return local;
}

class HarmonicSolver {
 public:
  HarmonicSolver(const BoundaryBasis& basis, const HarmonicIsometricProblem& problem)
      : problem_(problem), samples_(basis.samples()), n_(basis.size()) {
    real_columns(basis.values(basis.samples(), 1), re_, im_);
    const MatrixXc at_pins = basis.values(problem.pins);
    const Index count = at_pins.rows();
    MatrixXd re, im;
    real_columns(at_pins, re, im);
    pins_.resize(4 * n_, 2 * count);  // Re f and Im f, for f = Phi + conj(Psi)
    pins_ << re, im, re, -im;
    targets_.resize(2 * count);
    for (Index i = 0; i < count; ++i) {
      targets_[i] = problem.targets[static_cast<size_t>(i)].real();
      targets_[count + i] = problem.targets[static_cast<size_t>(i)].imag();
    }
    // The start: Phi is the best rotation of the pins. Cauchy coordinates reproduce z.
    Complex turn = 1, move = 0;
    if (count > 0) {
      const Similarity best = similarity_between(problem.pins, problem.targets);
      turn = std::abs(best.factor) > 0 ? best.factor / std::abs(best.factor) : Complex(1);
      move = best.to - turn * best.from;
    }
    VectorXc phi(n_);
    for (Index j = 0; j < n_; ++j)
      phi[j] = turn * basis.polygon().points[static_cast<size_t>(j)] + move;
    x_ = VectorXd::Zero(4 * n_);
    x_.head(2 * n_) = stacked(phi);
  }

  HarmonicIsometricMap run(int most, const std::stop_token& stop) {
    HarmonicIsometricMap out;
    double value = total(x_, out.energy);
    for (; out.iterations < most; ++out.iterations) {
      throw_if_stopped(stop);
      const VectorXd d = step();
      if (!d.allFinite()) break;
      const double slope = gradient_.dot(d);
      constexpr double kSettled = 1e-12;
      if (-slope <= kSettled * value) {
        out.converged = true;
        break;
      }
      double part = 1, next = 0, energy = 0;
      constexpr double kArmijo = 1e-4, kShortest = 1e-12;
      for (; part > kShortest; part *= 0.5) {
        next = total(x_ + part * d, energy);
        if (next <= value + kArmijo * part * slope) break;
      }
      if (part <= kShortest) {
        out.converged = true;  // rounding prevents any further decrease
        break;
      }
      x_ += part * d;
      value = next;
      out.energy = energy;
    }
    out.total = value;
    out.phi = complex_of(x_.head(2 * n_));
    out.psi = complex_of(x_.tail(2 * n_));
    return out;
  }

 private:
  double total(const VectorXd& x, double& energy) const {
    const VectorXd a = transposed_product(re_, x.head(2 * n_)),
                   b = transposed_product(im_, x.head(2 * n_)),
                   c = transposed_product(re_, x.tail(2 * n_)),
                   d = transposed_product(im_, x.tail(2 * n_));
    energy = 0;
    VectorXc fz(a.size());
    for (Index i = 0; i < a.size(); ++i) {
      fz[i] = {a[i], b[i]};
      energy += problem_.weights[i] * energy_of(fz[i], {c[i], d[i]});
    }
    if (winds_around_zero(samples_, fz)) return std::numeric_limits<double>::infinity();
    return energy + problem_.penalty * (transposed_product(pins_, x) - targets_).squaredNorm();
  }

  VectorXd step() {
    const Index m = re_.cols(), rows = 2 * n_;
    const VectorXd a = transposed_product(re_, x_.head(rows)),
                   b = transposed_product(im_, x_.head(rows)),
                   c = transposed_product(re_, x_.tail(rows)),
                   d = transposed_product(im_, x_.tail(rows));
    MatrixXd columns(4 * n_, 4 * m);
    VectorXd local_gradient(4 * m);
    for (Index i = 0; i < m; ++i) {
      const Local local = local_at({a[i], b[i]}, {c[i], d[i]});
      local_gradient.segment<4>(4 * i) = problem_.weights[i] * local.gradient;
      // The columns' Gram matrix is the sample's part of the Hessian.
      const Eigen4 eigen = eigen_decomposition(problem_.weights[i] * local.hessian);
      for (Index k = 0; k < 4; ++k) {
        const Vector4 v = std::sqrt(std::max(0.0, eigen.values[k])) * eigen.vectors.col(k);
        columns.col(4 * i + k).head(rows) = v[0] * re_.col(i) + v[1] * im_.col(i);
        columns.col(4 * i + k).tail(rows) = v[2] * re_.col(i) + v[3] * im_.col(i);
      }
    }
    gradient_ = VectorXd::Zero(4 * n_);
    for (Index i = 0; i < m; ++i) {
      const Vector4 g = local_gradient.segment<4>(4 * i);
      gradient_.head(rows) += g[0] * re_.col(i) + g[1] * im_.col(i);
      gradient_.tail(rows) += g[2] * re_.col(i) + g[3] * im_.col(i);
    }
    const VectorXd off = transposed_product(pins_, x_) - targets_;
    gradient_ += 2 * problem_.penalty * product(pins_, off);
    MatrixXd hessian = MatrixXd::Zero(4 * n_, 4 * n_);
    add_gram(columns, columns.cols(), 0, hessian);
    const MatrixXd pulled = std::sqrt(2 * problem_.penalty) * pins_;
    add_gram(pulled, pulled.cols(), 0, hessian);
    double ridge = 1e-12 * hessian.diagonal().mean();  // Phi and Psi share a constant
    Cholesky cholesky;
    if (!hessian.allFinite()) return VectorXd::Constant(4 * n_, std::nan(""));
    do {
      hessian.diagonal().array() += ridge;
      ridge *= 10;
    } while (!cholesky.factor(hessian));
    return -cholesky.solve(gradient_);
  }

  const HarmonicIsometricProblem& problem_;
  PolygonView samples_;
  Index n_;
  MatrixXd re_, im_, pins_;
  VectorXd targets_, x_, gradient_;
};

}  // namespace

HarmonicIsometricMap harmonic_isometric(const BoundaryBasis& basis,
                                        const HarmonicIsometricProblem& problem,
                                        int most_iterations, std::stop_token stop) {
  check(problem.weights.size() == static_cast<Index>(basis.samples().size()) &&
            problem.pins.size() == problem.targets.size(),
        "harmonic isometric: sizes agree");
  return HarmonicSolver(basis, problem).run(most_iterations, stop);
}

}  // namespace holomorph
