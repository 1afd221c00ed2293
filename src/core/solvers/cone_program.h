// Small dense second-order cone programs: a convex fit under cone constraints at many samples.
//
//     minimize   x'Px / 2 + c'x + constant + weight * sum of |fit_k . a - wanted_k|
//     subject to |w_i(b)| <= height_ci(u_i(a))   for each sample i and each cone c,
//                height(u) = offset + slope u - decay e^-u,
//
// The unknowns are x = (a, b). u_i is real-linear in a; w_i is complex and real-linear in b. These
// are the programs of bounded distortion (Levi, Weber 2016), where u = ln |f_z| and w = nu or Psi'.
#pragma once

#include "core/solvers/dense.h"

namespace holomorph {

/// height(u) = offset + slope u - decay e^-u, decay >= 0. It is concave, which makes the feasible
/// set of the cone convex.
struct Cone {
  VectorXd offset;  ///< one value for all samples, or one per sample
  double slope = 0, decay = 0;

  /// The height at a sample. The caller also provides e^-u.
  double height(Index sample, double u, double exp_minus_u) const {
    const double bend =
        decay > 0 ? decay * exp_minus_u : 0;  // e^-u may overflow where it is unused
    return offset[offset.size() == 1 ? 0 : sample] + slope * u - bend;
  }
};

/// The part of a program that does not change when the targets move. There are p unknowns a, q
/// unknowns b, m samples and k rows of the fit.
struct ConeSystem {
  MatrixXd height;          ///< p x m: u_i = height.col(i) . a; p = 0: u = 0
  MatrixXd re, im;          ///< q x m: w_i = (re.col(i) . b, im.col(i) . b); q = 0: w = 0
  std::vector<Cone> cones;  ///< each applies to every sample
  MatrixXd quadratic;       ///< P, (p + q) x (p + q), positive semidefinite, both triangles
  MatrixXd fit;             ///< p x k; k may be 0
  double fit_weight = 1;

  Index samples() const { return std::max(height.cols(), re.cols()); }
  Index unknowns() const { return height.rows() + re.rows(); }
};

/// The part of a program that changes when the targets move.
struct ConeTarget {
  VectorXd linear;  ///< c: p + q
  double constant = 0;
  VectorXd wanted;  ///< k
};

struct ConeSettings {
  double gap = 1e-4;        ///< tolerance for the sum of all slacks times their multipliers
  double relative_gap = 0;  ///< as a fraction of the energy; the larger tolerance applies
  double residual = 3e-3;   ///< tolerance for the norm of the Lagrangian's gradient
  double neglected = 0;     ///< the Hessian omits samples with a lower barrier curvature
  int iterations = 60;
  /// The slacks times the multipliers, summed over a cone's samples, where a start has no
  /// multipliers. Small values suit starts near the solution.
  double first_gap = 0.1;
};

/// A strictly feasible x, the multipliers, and their accuracy.
struct ConeSolution {
  enum class Status { solved, stopped };
  Status status = Status::stopped;
  VectorXd x;
  std::vector<Eigen::Matrix3Xd> z;  ///< for each cone 3 x m: (height, w)
  VectorXd fit_duals;               ///< in (-1, 1), converging to the signs of the fit's residuals
  double energy = 0;
  double gap = 0, residual = 0;
  int iterations = 0;
};

/// Whether x lies strictly inside all cones.
bool is_feasible(const ConeSystem& system, const VectorXd& x);

/// The program's energy at x.
double energy_of(const ConeSystem& system, const ConeTarget& target, const VectorXd& x);

/// Solves the program from `start.x`, which must be strictly feasible (checked). If multipliers are
/// missing, for example for appended samples, they are filled in. Every iterate is strictly
/// feasible. The result is therefore inside all cones even if the solver stops after
/// settings.iterations. Method: primal-dual interior points with Nesterov-Todd scaling and
/// Mehrotra's corrector. The duals of Chan, Golub, Mulet 1999 handle the L1 norm. The absolute
/// values are bounded by additional unknowns, which are eliminated. With a smoothed norm, the
/// smoothing decreased faster than the steps could follow, and some poses did not converge. Cost
/// per iteration: one Cholesky factorization and one symmetric product of (p + q)^2 (m + k) / 2.
ConeSolution solved(const ConeSystem& system, const ConeTarget& target,
                    const ConeSettings& settings, const ConeSolution& start);

}  // namespace holomorph
