#include "core/solvers/products.h"

namespace holomorph {

VectorXc product(const MatrixXc& a, const VectorXc& x) {
  return a * x;
}

VectorXc adjoint_product(const MatrixXc& a, const VectorXc& x) {
  return a.adjoint() * x;
}

MatrixXd self_product(const MatrixXd& a) {
  return a * a.transpose();
}

}  // namespace holomorph
