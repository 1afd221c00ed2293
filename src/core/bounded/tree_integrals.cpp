#include "core/bounded/tree_integrals.h"

#include "core/error.h"
#include "core/solvers/factors.h"
#include "core/solvers/real_form.h"

namespace holomorph {

TreeIntegrals::TreeIntegrals(const BoundaryBasis& basis, const Mesh& mesh, const Points& stations,
                             const std::vector<Points>& loops)
    : paths_(mesh, basis.polygon(), stations, loops),
      stations_(static_cast<Index>(stations.size())),
      ends_(paths_.ends()) {
  if (!ends_.empty()) ends_.erase(ends_.begin());
  ends_.insert(ends_.end(), paths_.loops().begin(), paths_.loops().end());
  values_ = basis.values(paths_.nodes());
  whitened_ = basis.whitened(values_);
}

VectorXc TreeIntegrals::sums(const VectorXc& at_nodes) const {
  const auto& pieces = paths_.pieces();
  VectorXc along(static_cast<Index>(pieces.size()));
  for (Index e = 0; e < along.size(); ++e) {
    along[e] = at_nodes.segment(e * PathTree::kNodes, PathTree::kNodes).sum();
    if (const Index parent = pieces[static_cast<size_t>(e)].parent; parent >= 0)
      along[e] += along[parent];
  }
  VectorXc sums(count());
  for (Index i = 0; i < sums.size(); ++i) {
    const Index end = ends_[static_cast<size_t>(i)];
    sums[i] = end >= 0 ? along[end] : Complex(0);
  }
  return sums;
}

// dG = a . dl + conj(b . dl + c . dw), one row for each combination.
LogMap TreeIntegrals::smallest(const Change& change, const BoundaryBasis& basis,
                               const Derivatives& at) const {
  const Index n = basis.unknowns(), rows = change.combinations.rows();
  const bool is_nu = change.second == LogMap::Second::nu;
  const VectorXc by_w = is_nu ? at.phi : weights();
  MatrixXc a(rows, n), b = MatrixXc::Zero(rows, n), c = MatrixXc::Zero(rows, n);
  const auto combined = [&](const VectorXc& factors, Index k) {
    return (change.combinations * sums(factors.cwiseProduct(whitened_.col(k)))).eval();
  };
  for (Index k = 0; k < n; ++k) {
    a.col(k) = combined(at.phi, k);
    if (is_nu) b.col(k) = combined(at.psi, k);
    if (!change.conformal) c.col(k) = combined(by_w, k);
  }
  MatrixXd are, aim, bre, bim, cre, cim;
  real_columns(a, are, aim);
  real_columns(b, bre, bim);
  real_columns(c, cre, cim);
  const Index more = change.gains.size();
  MatrixXd columns(4 * n, 2 * rows + more);
  columns.leftCols(2 * rows) << are + bre, aim - bim, cre, -cim;
  VectorXd wanted(2 * rows + more);
  wanted << stacked(change.wanted), change.gains;
  if (more > 0) {
    real_columns(change.rows_l, are, aim);
    real_columns(change.rows_w, bre, bim);
    columns.rightCols(more) << are, bre;
  }
  const VectorXd x = columns * solve_symmetric(columns.transpose() * columns, wanted);
  LogMap result{VectorXc::Zero(basis.size()), VectorXc::Zero(basis.size()), change.second};
  if (!x.allFinite()) return result;
  result.l = basis.coefficients(complex_of(x.head(2 * n)));
  result.w = basis.coefficients(complex_of(x.tail(2 * n)));
  return result;
}

}  // namespace holomorph
