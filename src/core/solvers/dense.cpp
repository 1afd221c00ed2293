// Calls CBLAS and LAPACK on Eigen's column-major storage.
#include "core/solvers/dense.h"

#include <cblas.h>
#include <f77blas.h>

#include "core/error.h"

extern "C" {
void zgeqrf_(const int* m, const int* n, void* a, const int* lda, void* tau, void* work,
             const int* lwork, int* info);
void zungqr_(const int* m, const int* n, const int* k, void* a, const int* lda, const void* tau,
             void* work, const int* lwork, int* info);
void zunmqr_(const char* side, const char* trans, const int* m, const int* n, const int* k,
             const void* a, const int* lda, const void* tau, void* c, const int* ldc, void* work,
             const int* lwork, int* info);
}

namespace holomorph {
namespace {

VectorXd multiplied(CBLAS_TRANSPOSE transposed, const MatrixXd& a, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(transposed == CblasTrans ? a.cols() : a.rows());
  if (a.size() > 0)
    cblas_dgemv(CblasColMajor, transposed, static_cast<int>(a.rows()), static_cast<int>(a.cols()),
                1.0, a.data(), static_cast<int>(a.rows()), x.data(), 1, 0.0, y.data(), 1);
  return y;
}

MatrixXd multiplied(CBLAS_TRANSPOSE transposed, const MatrixXd& a, const MatrixXd& b) {
  MatrixXd c = MatrixXd::Zero(transposed == CblasTrans ? a.cols() : a.rows(), b.cols());
  if (a.size() > 0 && b.size() > 0)
    cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, static_cast<int>(c.rows()),
                static_cast<int>(c.cols()), static_cast<int>(b.rows()), 1.0, a.data(),
                static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), 1.0, c.data(),
                static_cast<int>(c.rows()));
  return c;
}

template <class Syrk, class Matrix>
void add_gram_by(Syrk syrk, const Matrix& k, Index columns, Index first, Matrix& out) {
  if (columns == 0 || k.rows() == 0) return;
  syrk(CblasColMajor, CblasLower, CblasNoTrans, static_cast<int>(k.rows()),
       static_cast<int>(columns), 1, k.data(), static_cast<int>(k.rows()), 1, &out(first, first),
       static_cast<int>(out.rows()));
}

struct BlockCorner {
  Index row, column;
};

template <class Gemm, class Matrix>
void add_product_by(Gemm gemm, const Matrix& a, const Matrix& b, Index columns, BlockCorner at,
                    Matrix& out) {
  if (columns == 0 || a.rows() == 0 || b.rows() == 0) return;
  gemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(a.rows()),
       static_cast<int>(b.rows()), static_cast<int>(columns), 1, a.data(),
       static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), 1, &out(at.row, at.column),
       static_cast<int>(out.rows()));
}

}  // namespace

VectorXd product(const MatrixXd& a, const VectorXd& x) {
  return multiplied(CblasNoTrans, a, x);
}
VectorXd transposed_product(const MatrixXd& a, const VectorXd& x) {
  return multiplied(CblasTrans, a, x);
}

MatrixXd matrix_product(const MatrixXd& a, const MatrixXd& b) {
  return multiplied(CblasNoTrans, a, b);
}
MatrixXd transposed_matrix_product(const MatrixXd& a, const MatrixXd& b) {
  return multiplied(CblasTrans, a, b);
}
MatrixXc matrix_product(const MatrixXc& a, const MatrixXc& b) {
  MatrixXc c = MatrixXc::Zero(a.rows(), b.cols());
  const Complex one = 1;
  if (a.size() > 0 && b.size() > 0)
    cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(a.rows()),
                static_cast<int>(b.cols()), static_cast<int>(a.cols()), &one, a.data(),
                static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), &one, c.data(),
                static_cast<int>(c.rows()));
  return c;
}

void add_gram(const MatrixXd& k, Index columns, Index first, MatrixXd& out) {
  add_gram_by(cblas_dsyrk, k, columns, first, out);
}
void add_gram(const Eigen::MatrixXf& k, Index columns, Index first, Eigen::MatrixXf& out) {
  add_gram_by(cblas_ssyrk, k, columns, first, out);
}

void add_product(const MatrixXd& a, const MatrixXd& b, Index columns, Index row, Index column,
                 MatrixXd& out) {
  add_product_by(cblas_dgemm, a, b, columns, {row, column}, out);
}
void add_product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, Index columns, Index row,
                 Index column, Eigen::MatrixXf& out) {
  add_product_by(cblas_sgemm, a, b, columns, {row, column}, out);
}

Orthonormal orthonormal(MatrixXc a) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols());
  check(m >= n && n > 0, "orthonormal: at least as many rows as columns");
  constexpr int kBlock = 64;
  const int room = n * kBlock;
  VectorXc tau(n), work(room);
  int wrong = 0;
  zgeqrf_(&m, &n, a.data(), &m, tau.data(), work.data(), &room, &wrong);
  check(wrong == 0, "orthonormal: LAPACK's arguments");
  MatrixXc r = a.topRows(n).triangularView<Eigen::Upper>();
  zungqr_(&m, &n, &n, a.data(), &m, tau.data(), work.data(), &room, &wrong);
  check(wrong == 0, "orthonormal: LAPACK's arguments");
  return {std::move(a), std::move(r)};
}

VectorXc least_squares(MatrixXc a, VectorXc b) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols()), one = 1;
  check(m >= n && n > 0 && b.size() == m, "least squares: at least as many rows as columns");
  constexpr int kBlock = 64;
  const int room = (n + 1) * kBlock;
  VectorXc tau(n), work(room);
  int wrong = 0;
  zgeqrf_(&m, &n, a.data(), &m, tau.data(), work.data(), &room, &wrong);
  check(wrong == 0, "least squares: LAPACK's arguments");
  const char left = 'L', adjoint = 'C';
  zunmqr_(&left, &adjoint, &m, &one, &n, a.data(), &m, tau.data(), b.data(), &m, work.data(), &room,
          &wrong);
  check(wrong == 0, "least squares: LAPACK's arguments");
  return a.topRows(n).triangularView<Eigen::Upper>().solve(b.head(n));
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

MatrixXd Cholesky::solve_all(MatrixXd right) const {
  const int n = static_cast<int>(lower_.rows()), columns = static_cast<int>(right.cols());
  if (right.size() == 0) return right;
  for (const CBLAS_TRANSPOSE transposed : {CblasNoTrans, CblasTrans})
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed, CblasNonUnit, n, columns, 1.0,
                lower_.data(), n, right.data(), n);
  return right;
}

}  // namespace holomorph
