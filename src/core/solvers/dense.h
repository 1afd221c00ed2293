// Dense real linear algebra by BLAS: what a solver repeats in every iteration.
//
// The library chooses its instruction set when the program runs and has a portable path.
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

/// Adds K K^T of the first `columns` columns to the lower triangle of out's block that starts at
/// (first, first) and has K's rows. Cost: rows^2 * columns multiplications, half of them saved.
void add_gram(const MatrixXd& k, Index columns, Index first, MatrixXd& out);
void add_gram(const Eigen::MatrixXf& k, Index columns, Index first, Eigen::MatrixXf& out);

/// Adds A B^T of the first `columns` columns to out's block at (row, column).
void add_product(const MatrixXd& a, const MatrixXd& b, Index columns, Index row, Index column,
                 MatrixXd& out);
void add_product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, Index columns, Index row,
                 Index column, Eigen::MatrixXf& out);

/// A = Q R with orthonormal columns of Q and R upper triangular, by Householder's reflections. A
/// has as many rows as columns at least.
struct Orthonormal {
  MatrixXc q, r;
};
Orthonormal orthonormal(MatrixXc a);

/// The x with the least |A x - b|, by Householder's reflections. A has at least as many rows as
/// columns and full rank. Rows of very different sizes keep their digits when they are
/// sorted by size, the largest first.
VectorXc least_squares(MatrixXc a, VectorXc b);

/// A symmetric positive definite matrix as L L^T; reads the lower triangle only.
class Cholesky {
 public:
  /// Returns false when the matrix is not positive definite to rounding.
  bool factor(const MatrixXd& matrix);
  VectorXd solve(const VectorXd& right) const;
  /// The same for all columns at once.
  MatrixXd solve_all(MatrixXd right) const;

 private:
  MatrixXd lower_;
};

}  // namespace holomorph
