// The only instantiations of Eigen's dense factorizations of run-time size, but for one in
// geometry/curve.cpp, which lies below.
#include "core/solvers/factors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "core/error.h"

namespace holomorph {

struct LeastSquares::Factor {
  Eigen::HouseholderQR<MatrixXc> qr;
};
LeastSquares::LeastSquares(const MatrixXc& a)
    : factor_(new Factor{Eigen::HouseholderQR<MatrixXc>(a)}) {}
VectorXc LeastSquares::solve(const VectorXc& b) const {
  check(factor_ != nullptr, "least squares: a factorization");
  return factor_->qr.solve(b);
}

struct ShortestLeastSquares::Factor {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
};
ShortestLeastSquares::ShortestLeastSquares(const MatrixXd& a)
    : factor_(new Factor{Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a)}) {}
VectorXd ShortestLeastSquares::solve(const VectorXd& b) const {
  check(factor_ != nullptr, "least squares: a factorization");
  return factor_->qr.solve(b);
}

VectorXd pivoted_least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

VectorXd solve_symmetric(const MatrixXd& a, const VectorXd& b) {
  return a.ldlt().solve(b);
}
MatrixXd solve_symmetric_all(const MatrixXd& a, const MatrixXd& b) {
  return a.ldlt().solve(b);
}
MatrixXc solve_hermitian_all(const MatrixXc& a, const MatrixXc& b) {
  return a.ldlt().solve(b);
}

VectorXc solve_square(const MatrixXc& a, const VectorXc& b) {
  return a.partialPivLu().solve(b);
}
MatrixXc solve_nearly_singular(const MatrixXc& a, const MatrixXc& b) {
  return a.fullPivLu().solve(b);
}

Eigen4 eigen_decomposition(const Eigen::Matrix4d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(symmetric);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace holomorph
