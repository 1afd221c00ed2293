// Dense products by Eigen, compiled once: inline, each takes a second or more in every file.
#pragma once

#include "core/types.h"

namespace holomorph {

VectorXc product(const MatrixXc& a, const VectorXc& x);
/// a^* x
VectorXc adjoint_product(const MatrixXc& a, const VectorXc& x);
/// a a^T
MatrixXd self_product(const MatrixXd& a);

}  // namespace holomorph
