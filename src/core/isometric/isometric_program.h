// Minimizes the isometric energy of a map whose pins are soft.
//
//     minimize   sum of w_i e(u_i, nu_i) + penalty * sum of s_j |c_j|^2 + sum of r_k |z_k|^2
//                + closing * sum of |g_h|^2 + barrier * sum of w_i b(u_i, nu_i)
//
// u_i = Re l and nu_i are linear in the unknowns, which are the whitened coefficients of l and nu.
// Therefore the first sum is convex. c_j = f(p_j) - target_j - (the weighted mean of these
// differences) is not linear: f - z is the integral of e^l - 1 and of conj(nu e^l) along paths. z_k
// are the deviations of l and nu from prescribed values, for pins with rotation and scale. g_h is
// the integral of df around a hole, which must vanish. b is a barrier that keeps the map within
// bounds on its distortion, if there are any.
#pragma once

#include <limits>
#include <optional>
#include <stop_token>

#include "core/cauchy/cauchy_array.h"
#include "core/isometric/barrier.h"
#include "core/isometric/energy.h"
#include "core/mesh/path_tree.h"
#include "core/solvers/dense.h"

namespace holomorph {

/// The part of a program that does not change while handles are moved. There are n unknowns each
/// for l and nu, m samples, and one weight for each station of the paths.
struct IsometricSystem {
  IsometricEnergy energy;
  MatrixXd re, im;   ///< 2n x m: the real and imaginary parts of a basis function at the samples
  VectorXd weights;  ///< w: m
  PathTree paths;
  MatrixXc nodes;                        ///< nodes of the paths x n: the whitened basis
  PlanarMatrix<double> nodes_by_column;  ///< its transpose, for sums over nodes
  VectorXd station_weights;              ///< s
  MatrixXc frames;         ///< the whitened basis at points where l is prescribed, one per row
  VectorXd frame_weights;  ///< r
  double closing = 0;      ///< the penalty of gaps at holes
  std::optional<Barrier> barrier;  ///< b

  Index size() const { return re.rows() / 2; }      ///< n
  Index unknowns() const { return 2 * re.rows(); }  ///< real: (Re, Im) of l, then of nu
};

/// The part of a program that changes when handles move.
struct IsometricTarget {
  VectorXc stations;  ///< displacements, target_j - p_j
  VectorXc frames;    ///< the prescribed values of l
};

/// An iterate. |nu| < 1 at all samples, and the bounds hold there, if there are any.
struct IsometricSolution {
  VectorXd x;
  VectorXc offsets;    ///< c, one for each station
  VectorXc gaps;       ///< g, one for each loop of the paths
  Complex move;        ///< the displacement of the root
  double energy = 0;   ///< weighted mean of e, without the other terms
  double total = 0;    ///< the value that is minimized
  double barrier = 0;  ///< the barrier's part of it
  int iterations = 0;
  bool converged = false;
  double step = 1;  ///< the part of the last Newton step that was taken
};

struct IsometricSettings {
  double penalty = 1;
  double barrier = 0;  ///< must be positive if the system has a barrier
  int iterations = 200;
  /// The iteration stops when the Newton decrement is below this fraction of the total.
  double tolerance = 1e-13;
  /// If a pin misses by more than this, or if steps near the minimum are too long, the second
  /// derivatives of the pins are added, as far as the matrix stays definite. Use it for final
  /// answers; strained poses then need fewer iterations. Infinite: they are never added.
  double far = std::numeric_limits<double>::infinity();
  bool single = false;  ///< compute the Hessian in single precision
  std::stop_token stop = {};
};

/// Minimizes from a start that is_inside (checked). The value decreases in every iteration. Throws
/// Stopped on request. Method: Newton's, with Gauss-Newton for
/// the stations. Cost of an iteration: 10 m n^2 multiplications and one Cholesky factorization of
/// size 4n.
IsometricSolution minimized(const IsometricSystem& system, const IsometricTarget& target,
                            const IsometricSettings& settings, VectorXd start);

/// Changes x, which is_inside (checked), as little as possible until no gap exceeds `small`.
/// Gauss-Newton steps; if a gap remains, the result's `gaps` show it. For domains with holes.
IsometricSolution closed(const IsometricSystem& system, const IsometricTarget& target,
                         const IsometricSettings& settings, VectorXd x, double small);

/// Whether |nu| < 1 and the energy is finite at all samples, and the bounds hold there, if there
/// are any.
bool is_inside(const IsometricSystem& system, const VectorXd& x);
/// The value at x; infinite unless x is_inside.
double isometric_value(const IsometricSystem& system, const IsometricTarget& target,
                       const IsometricSettings& settings, const VectorXd& x);
/// The value, its gradient, and the matrix of a Newton step at x, for tests.
struct IsometricDerivatives {
  double value = 0;
  VectorXd gradient;
  MatrixXd hessian;  ///< lower triangle
};
IsometricDerivatives isometric_derivatives(const IsometricSystem& system,
                                           const IsometricTarget& target,
                                           const IsometricSettings& settings, const VectorXd& x);

}  // namespace holomorph
