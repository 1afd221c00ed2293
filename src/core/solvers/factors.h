// Factorizations by Eigen, compiled once. Eigen's templates would take seconds in each file that
// uses them. Where the time of a solve matters, dense.h calls BLAS and LAPACK.
#pragma once

#include <memory>

#include "core/types.h"

namespace holomorph {

/// The x that minimizes |A x - b|, for many b. A must have full rank and at least as many rows as
/// columns. Copies share the factorization; a default-constructed one has none and cannot solve.
class LeastSquares {
 public:
  LeastSquares() = default;
  /// Cost: a Householder QR factorization.
  explicit LeastSquares(const MatrixXc& a);
  VectorXc solve(const VectorXc& b) const;

 private:
  struct Factor;
  std::shared_ptr<const Factor> factor_;
};

/// The shortest of all x that minimize |A x - b|, for many b and for A of any rank. Copies share
/// the factorization; a default-constructed one has none and cannot solve.
class ShortestLeastSquares {
 public:
  ShortestLeastSquares() = default;
  /// Cost: a complete orthogonal decomposition.
  explicit ShortestLeastSquares(const MatrixXd& a);
  VectorXd solve(const VectorXd& b) const;

 private:
  struct Factor;
  std::shared_ptr<const Factor> factor_;
};

/// The x that minimizes |A x - b|, by a QR factorization with column pivoting.
VectorXd pivoted_least_squares(const MatrixXd& a, const VectorXd& b);

/// A^-1 b for a symmetric (Hermitian) A that is positive definite, or singular with b in its range,
/// by L D L^T with pivoting. A is n x n, and b has n rows. A singular A without such a solution
/// gives infinities or NaN.
VectorXd solve_symmetric(const MatrixXd& a, const VectorXd& b);
MatrixXd solve_symmetric_all(const MatrixXd& a, const MatrixXd& b);
MatrixXc solve_hermitian_all(const MatrixXc& a, const MatrixXc& b);

/// A^-1 b for a square A: by an LU factorization with partial pivoting, and with full pivoting for
/// an A that may be nearly singular. Both give infinities or NaN for a singular one.
VectorXc solve_square(const MatrixXc& a, const VectorXc& b);
MatrixXc solve_nearly_singular(const MatrixXc& a, const MatrixXc& b);

/// A symmetric 4 x 4 matrix as V diag(values) V^T, with increasing values.
struct Eigen4 {
  Eigen::Vector4d values;
  Eigen::Matrix4d vectors;
};
Eigen4 eigen_decomposition(const Eigen::Matrix4d& symmetric);

}  // namespace holomorph
