// Complex unknowns as real ones, (Re x, Im x), for solvers that handle only real numbers.
#pragma once

#include "core/types.h"

namespace holomorph {

/// For each complex row of q, sets a column of `re` and of `im` such that
/// Re(q x) = re . (Re x, Im x) and Im(q x) = im . (Re x, Im x). Both matrices are 2n x m if q is
/// m x n.
inline void real_columns(const MatrixXc& q, MatrixXd& re, MatrixXd& im) {
  const Index n = q.cols();
  re.resize(2 * n, q.rows());
  im.resize(2 * n, q.rows());
  re.topRows(n) = q.real().transpose();
  re.bottomRows(n) = -q.imag().transpose();
  im.topRows(n) = q.imag().transpose();
  im.bottomRows(n) = q.real().transpose();
}

/// Appends `columns` to the columns of `to`.
inline void append_columns(const MatrixXd& columns, MatrixXd& to) {
  const Index before = to.cols();
  to.conservativeResize(columns.rows(), before + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

inline VectorXd stacked(const VectorXc& x) {
  VectorXd real(2 * x.size());
  real << x.real(), x.imag();
  return real;
}

inline VectorXc complex_of(const VectorXd& x) {
  const Index n = x.size() / 2;
  VectorXc result(n);
  result.real() = x.head(n);
  result.imag() = x.tail(n);
  return result;
}

}  // namespace holomorph
