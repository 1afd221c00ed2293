// Calls of CBLAS and of LAPACK's potrf on Eigen's column-major storage.
#include "core/dense.h"

#include <cblas.h>
#include <f77blas.h>

namespace holomorph {

void add_gram(const MatrixXd& k, Index columns, Index first, MatrixXd& out) {
  if (columns == 0 || k.rows() == 0) return;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, static_cast<int>(k.rows()),
              static_cast<int>(columns), 1.0, k.data(), static_cast<int>(k.rows()), 1.0,
              &out(first, first), static_cast<int>(out.rows()));
}

void add_product(const MatrixXd& a, const MatrixXd& b, Index columns, Index row, Index column,
                 MatrixXd& out) {
  if (columns == 0 || a.rows() == 0 || b.rows() == 0) return;
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(a.rows()),
              static_cast<int>(b.rows()), static_cast<int>(columns), 1.0, a.data(),
              static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), 1.0,
              &out(row, column), static_cast<int>(out.rows()));
}

bool Cholesky::factor(const MatrixXd& matrix) {
  lower_ = matrix;
  char part = 'L';
  int n = static_cast<int>(lower_.rows()), wrong = 0;
  dpotrf_(&part, &n, lower_.data(), &n, &wrong);
  return wrong == 0;
}

VectorXd Cholesky::solve(const VectorXd& right) const {
  VectorXd x = right;
  const int n = static_cast<int>(lower_.rows());
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, lower_.data(), n, x.data(),
              1);
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, lower_.data(), n, x.data(),
              1);
  return x;
}

}  // namespace holomorph
