// Iterates are g = R x: Q g are the scaled values, Q* of the scaled targets is the next g.
#include "core/alternating_fit.h"

#include <Eigen/QR>

#include "core/dense.h"
#include "core/error.h"
#include "core/real_form.h"

namespace holomorph {
namespace {

constexpr size_t kMemory = 5;
constexpr double kAlong = 0.1;  ///< what going along the target's tangent costs in the first order

}  // namespace

AlternatingFit::AlternatingFit(std::vector<FitTerm> terms) : terms_(std::move(terms)) {
  Index rows = 0;
  for (const FitTerm& term : terms_) {
    first_.push_back(rows);
    rows += term.rows.rows();
    scale_.push_back(std::sqrt(term.weight / static_cast<double>(term.rows.rows())));
  }
  const Index n = terms_.at(0).rows.cols();
  MatrixXc all(rows, n);
  for (size_t t = 0; t < terms_.size(); ++t)
    all.middleRows(first_[t], terms_[t].rows.rows()) = scale_[t] * terms_[t].rows;
  check(rows >= n, "alternating fit: as many rows as unknowns");
  Orthonormal factors = orthonormal(std::move(all));
  q_ = std::move(factors.q);
  r_ = std::move(factors.r);
  values_.resize(terms_.size());
  targets_.resize(terms_.size());
  for (size_t t = 0; t < terms_.size(); ++t) targets_[t] = VectorXc::Zero(terms_[t].rows.rows());
}

void AlternatingFit::start(const VectorXc& first_targets) {
  memory_ = {};
  evaluate(VectorXc::Zero(r_.cols()));
  targets_[0] = first_targets;
  evaluate(zeroth());
}

VectorXc AlternatingFit::unknowns() const {
  return r_.triangularView<Eigen::Upper>().solve(g_);
}

double AlternatingFit::distance(size_t term) const {
  return std::sqrt((values_[term] - targets_[term]).squaredNorm() /
                   static_cast<double>(values_[term].size()));
}

/// Values, targets and the energy at g.
void AlternatingFit::evaluate(const VectorXc& g) {
  g_ = g;
  const VectorXc scaled = q_ * g;
  energy_ = 0;
  for (size_t t = 0; t < terms_.size(); ++t) {
    values_[t] = scaled.segment(first_[t], terms_[t].rows.rows()) / scale_[t];
    terms_[t].project(values_[t], targets_[t]);
    energy_ += scale_[t] * scale_[t] * (values_[t] - targets_[t]).squaredNorm();
  }
}

VectorXc AlternatingFit::zeroth() const {
  VectorXc right(q_.rows());
  for (size_t t = 0; t < terms_.size(); ++t)
    right.segment(first_[t], targets_[t].size()) = scale_[t] * targets_[t];
  return q_.adjoint() * right;
}

/// The combination of the last steps that should leave nothing to do (Anderson 1965).
VectorXc AlternatingFit::anderson() {
  const VectorXc next = zeroth(), change = next - g_;
  memory_.g.push_back(next);
  memory_.change.push_back(change);
  if (memory_.g.size() > kMemory + 1) {
    memory_.g.erase(memory_.g.begin());
    memory_.change.erase(memory_.change.begin());
  }
  const Index m = static_cast<Index>(memory_.g.size()) - 1;
  if (m == 0) return next;
  // Real combinations: targets are no complex-linear function of the map.
  MatrixXd differences(2 * change.size(), m);
  for (Index i = 0; i < m; ++i)
    differences.col(i) = stacked(memory_.change[static_cast<size_t>(i + 1)] -
                                 memory_.change[static_cast<size_t>(i)]);
  const VectorXd share = differences.colPivHouseholderQr().solve(stacked(change));
  VectorXc mixed = next;
  for (Index i = 0; i < m; ++i)
    mixed -= share[i] * (memory_.g[static_cast<size_t>(i + 1)] - memory_.g[static_cast<size_t>(i)]);
  return mixed;
}

/// Targets may slide along their curves (SB16 eq. 13): with P = real form of Q's rows with normals,
/// M = I - (1 - along) P^T P + (1 - along) (n . P)^T (n . P).
VectorXc AlternatingFit::first_order() const {
  const Index n = r_.cols();
  MatrixXd m = MatrixXd::Identity(2 * n, 2 * n);
  VectorXd right = stacked(zeroth());
  for (size_t t = 0; t < terms_.size(); ++t) {
    if (!terms_[t].normals) continue;
    VectorXc normals(values_[t].size());
    terms_[t].normals(values_[t], targets_[t], normals);
    // Along the curve, with tangent i n: value and target need not agree.
    MatrixXd along(2 * n, normals.size());
    for (Index i = 0; i < normals.size(); ++i) {
      const auto row = q_.row(first_[t] + i);
      const Complex tangent = std::conj(kI * normals[i]);
      along.col(i).head(n) = (tangent * row).real().transpose();
      along.col(i).tail(n) = -(tangent * row).imag().transpose();
    }
    const VectorXd wanted =
        scale_[t] * (targets_[t].array() * (kI * normals.array()).conjugate()).real().matrix();
    const double relief = 1 - kAlong;
    MatrixXd gram = MatrixXd::Zero(2 * n, 2 * n);
    add_gram(along, along.cols(), 0, gram);
    m -= relief * gram;
    right -= relief * product(along, wanted);
  }
  Cholesky cholesky;
  if (!cholesky.factor(m)) return zeroth();
  return complex_of(cholesky.solve(right));
}

void AlternatingFit::step(Mode mode) {
  const VectorXc before = g_;
  const double energy = energy_;
  if (mode != Mode::zeroth) {
    evaluate(mode == Mode::anderson ? anderson() : first_order());
    if (energy_ <= energy) return;
    evaluate(before);
    memory_ = {};
  }
  evaluate(zeroth());
}

}  // namespace holomorph
