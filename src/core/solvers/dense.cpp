// Calls CBLAS and LAPACK on Eigen's column-major storage.
#include "core/solvers/dense.h"

#include <cblas.h>
#include <f77blas.h>

#include <algorithm>
#include <functional>
#include <mutex>

#include "core/error.h"
#include "core/parallel.h"

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

/// To be held during a call of BLAS. OpenBLAS without threads, or with those of OpenMP, shares its
/// buffers among all callers and can then be called by only one thread at a time. With threads of
/// its own it is safe, but these would compete with ours, so it uses the caller's alone.
std::unique_lock<std::mutex> blas_turn() {
  static std::mutex one;
  static const bool is_safe = [] {
    openblas_set_num_threads(1);
    return openblas_get_parallel() == OPENBLAS_THREAD;
  }();
  return is_safe ? std::unique_lock<std::mutex>() : std::unique_lock(one);
}

/// Calls `work` with the first column and the number of columns of each block of a result. If the
/// whole costs many multiplications, the blocks are shared among all cores. Their size does not
/// depend on the number of cores, so rounding does not, either.
void for_column_blocks(Index columns, double multiplications,
                       const std::function<void(Index first, Index count)>& work) {
  constexpr Index kColumns = 64;
  constexpr double kWorthThreads = 1e8;  // several milliseconds
  if (multiplications < kWorthThreads) return work(0, columns);
  parallel_for(static_cast<int>((columns + kColumns - 1) / kColumns), [&](int block) {
    const Index first = block * kColumns;
    work(first, std::min(kColumns, columns - first));
  });
}

double multiplications(Index rows, Index columns, Index inner) {
  return static_cast<double>(rows) * static_cast<double>(columns) * static_cast<double>(inner);
}

VectorXd multiplied(CBLAS_TRANSPOSE transposed, const MatrixXd& a, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(transposed == CblasTrans ? a.cols() : a.rows());
  if (a.size() == 0) return y;
  const auto turn = blas_turn();
  cblas_dgemv(CblasColMajor, transposed, static_cast<int>(a.rows()), static_cast<int>(a.cols()),
              1.0, a.data(), static_cast<int>(a.rows()), x.data(), 1, 0.0, y.data(), 1);
  return y;
}

MatrixXd multiplied(CBLAS_TRANSPOSE transposed, const MatrixXd& a, const MatrixXd& b) {
  MatrixXd c = MatrixXd::Zero(transposed == CblasTrans ? a.cols() : a.rows(), b.cols());
  if (a.size() == 0 || b.size() == 0) return c;
  for_column_blocks(
      c.cols(), multiplications(c.rows(), c.cols(), b.rows()), [&](Index first, Index count) {
        const auto turn = blas_turn();
        cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, static_cast<int>(c.rows()),
                    static_cast<int>(count), static_cast<int>(b.rows()), 1.0, a.data(),
                    static_cast<int>(a.rows()), b.col(first).data(), static_cast<int>(b.rows()),
                    1.0, c.col(first).data(), static_cast<int>(c.rows()));
      });
  return c;
}

struct BlockCorner {
  Index row, column;
};

template <class Gemm, class Matrix>
void add_product_by(Gemm gemm, const Matrix& a, const Matrix& b, Index columns, BlockCorner at,
                    Matrix& out) {
  if (columns == 0 || a.rows() == 0 || b.rows() == 0) return;
  for_column_blocks(b.rows(), multiplications(a.rows(), b.rows(), columns),
                    [&](Index first, Index count) {
                      const auto turn = blas_turn();
                      gemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(a.rows()),
                           static_cast<int>(count), static_cast<int>(columns), 1, a.data(),
                           static_cast<int>(a.rows()), b.data() + first, static_cast<int>(b.rows()),
                           1, &out(at.row, at.column + first), static_cast<int>(out.rows()));
                    });
}

template <class Syrk, class Gemm, class Matrix>
void add_gram_by(Syrk syrk, Gemm gemm, const Matrix& k, Index columns, Index first, Matrix& out) {
  if (columns == 0 || k.rows() == 0) return;
  const int stride = static_cast<int>(k.rows()), out_stride = static_cast<int>(out.rows());
  for_column_blocks(k.rows(), 0.5 * multiplications(k.rows(), k.rows(), columns),
                    [&](Index from, Index count) {
                      const Index to = from + count, at = first + from;
                      const auto* rows = k.data() + from;
                      const auto turn = blas_turn();
                      syrk(CblasColMajor, CblasLower, CblasNoTrans, static_cast<int>(count),
                           static_cast<int>(columns), 1, rows, stride, 1, &out(at, at), out_stride);
                      if (to == k.rows()) return;
                      gemm(CblasColMajor, CblasNoTrans, CblasTrans, static_cast<int>(k.rows() - to),
                           static_cast<int>(count), static_cast<int>(columns), 1, k.data() + to,
                           stride, rows, stride, 1, &out(first + to, at), out_stride);
                    });
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
  if (a.size() == 0 || b.size() == 0) return c;
  const Complex one = 1;
  for_column_blocks(
      c.cols(), 4 * multiplications(c.rows(), c.cols(), b.rows()), [&](Index first, Index count) {
        const auto turn = blas_turn();
        cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, static_cast<int>(a.rows()),
                    static_cast<int>(count), static_cast<int>(a.cols()), &one, a.data(),
                    static_cast<int>(a.rows()), b.col(first).data(), static_cast<int>(b.rows()),
                    &one, c.col(first).data(), static_cast<int>(c.rows()));
      });
  return c;
}

void add_gram(const MatrixXd& k, Index columns, Index first, MatrixXd& out) {
  add_gram_by(cblas_dsyrk, cblas_dgemm, k, columns, first, out);
}
void add_gram(const Eigen::MatrixXf& k, Index columns, Index first, Eigen::MatrixXf& out) {
  add_gram_by(cblas_ssyrk, cblas_sgemm, k, columns, first, out);
}

void add_product(const MatrixXd& a, const MatrixXd& b, Index columns, Index row, Index column,
                 MatrixXd& out) {
  add_product_by(cblas_dgemm, a, b, columns, {row, column}, out);
}
void add_product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, Index columns, Index row,
                 Index column, Eigen::MatrixXf& out) {
  add_product_by(cblas_sgemm, a, b, columns, {row, column}, out);
}

namespace {

constexpr int kPanel = 64;  // columns that LAPACK treats together

/// Factors A in place: R above the diagonal and reflections below. Returns their factors.
VectorXc factor_in_place(MatrixXc& a) {
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols());
  check(m >= n && n > 0, "factorization: at least as many rows as columns");
  const int room = n * kPanel;
  VectorXc tau(n), work(room);
  int wrong = 0;
  const auto turn = blas_turn();
  zgeqrf_(&m, &n, a.data(), &m, tau.data(), work.data(), &room, &wrong);
  check(wrong == 0, "factorization: LAPACK's arguments");
  return tau;
}

}  // namespace

MatrixXc upper_factor(MatrixXc a) {
  factor_in_place(a);
  return a.topRows(a.cols()).triangularView<Eigen::Upper>();
}

Orthonormal orthonormal(MatrixXc a) {
  const VectorXc tau = factor_in_place(a);
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols()), room = n * kPanel;
  MatrixXc r = a.topRows(n).triangularView<Eigen::Upper>();
  VectorXc work(room);
  int wrong = 0;
  const auto turn = blas_turn();
  zungqr_(&m, &n, &n, a.data(), &m, tau.data(), work.data(), &room, &wrong);
  check(wrong == 0, "orthonormal: LAPACK's arguments");
  return {std::move(a), std::move(r)};
}

MatrixXc solve_upper(const MatrixXc& r, MatrixXc b) {
  const int n = static_cast<int>(r.rows());
  if (b.size() == 0) return b;
  const Complex one = 1;
  for_column_blocks(b.cols(), 2 * multiplications(n, b.cols(), n), [&](Index first, Index count) {
    const auto turn = blas_turn();
    cblas_ztrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, n,
                static_cast<int>(count), &one, r.data(), n, b.col(first).data(), n);
  });
  return b;
}

VectorXc least_squares(MatrixXc a, VectorXc b) {
  const VectorXc tau = factor_in_place(a);
  const int m = static_cast<int>(a.rows()), n = static_cast<int>(a.cols()), one = 1, room = kPanel;
  check(b.size() == m, "least squares: one right side per row");
  VectorXc work(room);
  int wrong = 0;
  const char left = 'L', adjoint = 'C';
  {
    const auto turn = blas_turn();
    zunmqr_(&left, &adjoint, &m, &one, &n, a.data(), &m, tau.data(), b.data(), &m, work.data(),
            &room, &wrong);
  }
  check(wrong == 0, "least squares: LAPACK's arguments");
  return a.topRows(n).triangularView<Eigen::Upper>().solve(b.head(n));
}

bool Cholesky::factor(const MatrixXd& matrix) {
  lower_ = matrix;
  char part = 'L';
  int n = static_cast<int>(lower_.rows()), wrong = 0;
  const auto turn = blas_turn();
  dpotrf_(&part, &n, lower_.data(), &n, &wrong);
  return wrong == 0;
}

VectorXd Cholesky::solve(const VectorXd& right) const {
  VectorXd x = right;
  const int n = static_cast<int>(lower_.rows());
  const auto turn = blas_turn();
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, lower_.data(), n, x.data(),
              1);
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, lower_.data(), n, x.data(),
              1);
  return x;
}

MatrixXd Cholesky::solve_all(MatrixXd right) const {
  const int n = static_cast<int>(lower_.rows());
  if (right.size() == 0) return right;
  for_column_blocks(
      right.cols(), multiplications(n, right.cols(), n), [&](Index first, Index count) {
        const auto turn = blas_turn();
        for (const CBLAS_TRANSPOSE transposed : {CblasNoTrans, CblasTrans})
          cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed, CblasNonUnit, n,
                      static_cast<int>(count), 1.0, lower_.data(), n, right.col(first).data(), n);
      });
  return right;
}

}  // namespace holomorph
