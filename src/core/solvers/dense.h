// Dense linear algebra with BLAS, for the operations that solvers repeat in every iteration.
//
// The BLAS library selects the instruction set at run time and also has a portable code path.
// Large matrix products use all cores.
#pragma once

#include "core/types.h"

namespace holomorph {

/// A x and A^T x. A may be empty.
VectorXd product(const MatrixXd& a, const VectorXd& x);
VectorXd transposed_product(const MatrixXd& a, const VectorXd& x);
/// A B and A^T B.
MatrixXd matrix_product(const MatrixXd& a, const MatrixXd& b);
MatrixXc matrix_product(const MatrixXc& a, const MatrixXc& b);
MatrixXd transposed_matrix_product(const MatrixXd& a, const MatrixXd& b);

/// Adds K K^T, for the first `columns` columns of K, to the lower triangle of a block of `out`. The
/// block starts at (first, first) and has as many rows as K has. Cost: rows^2 * columns / 2
/// multiplications.
void add_gram(const MatrixXd& k, Index columns, Index first, MatrixXd& out);
void add_gram(const Eigen::MatrixXf& k, Index columns, Index first, Eigen::MatrixXf& out);

/// Adds A B^T, for the first `columns` columns of A and B, to the block of `out` at (row, column).
void add_product(const MatrixXd& a, const MatrixXd& b, Index columns, Index row, Index column,
                 MatrixXd& out);
void add_product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, Index columns, Index row,
                 Index column, Eigen::MatrixXf& out);

/// A = Q R by Householder reflections: Q has orthonormal columns, and R is upper triangular. A must
/// have at least as many rows as columns.
struct Orthonormal {
  MatrixXc q, r;
};
Orthonormal orthonormal(MatrixXc a);
/// Only the R of that, without the work for Q.
MatrixXc upper_factor(MatrixXc a);
/// R^-1 B for an upper triangular R without zeros on its diagonal. Cost: half as many complex
/// multiplications as R B with a full R.
MatrixXc solve_upper(const MatrixXc& r, MatrixXc b);

/// The x that minimizes |A x - b|, by Householder reflections. A must have full rank and at least
/// as many rows as columns. If rows have very different sizes, sort them by decreasing size to
/// preserve accuracy.
VectorXc least_squares(MatrixXc a, VectorXc b);

/// The factorization L L^T of a symmetric positive definite matrix. Only the lower triangle is
/// read.
class Cholesky {
 public:
  /// Returns false if the matrix is not positive definite up to rounding error.
  bool factor(const MatrixXd& matrix);
  VectorXd solve(const VectorXd& right) const;
  /// Solves for all columns of `right`.
  MatrixXd solve_all(MatrixXd right) const;

 private:
  MatrixXd lower_;
};

}  // namespace holomorph
