// Iterates on g = R x. The scaled values are Q g, and the next g is Q* times the scaled targets.
// The energy of the terms with given targets follows from |Q g| = |g| without using their rows.
#include "core/solvers/alternating_fit.h"

#include "core/error.h"
#include "core/solvers/dense.h"
#include "core/solvers/factors.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr size_t kMemory = 5;
constexpr double kAlong = 0.1;  ///< weight of the tangential distance in a first-order step

}  // namespace

AlternatingFit::AlternatingFit(std::vector<FitTerm> terms) {
  Index rows = 0;
  for (const FitTerm& term : terms) rows += term.rows.rows();
  const Index n = terms.at(0).rows.cols();
  check(rows >= n, "alternating fit: at least as many rows as unknowns");
  check(terms[0].project != nullptr, "alternating fit: the first term must have moving targets");
  MatrixXc all(rows, n);
  Index first = 0;
  for (FitTerm& term : terms) {
    Term kept;
    kept.scale = std::sqrt(term.weight / static_cast<double>(term.rows.rows()));
    all.middleRows(first, term.rows.rows()) = kept.scale * term.rows;
    first += term.rows.rows();
    kept.targets = VectorXc::Zero(term.rows.rows());
    kept.project = std::move(term.project);
    kept.normals = std::move(term.normals);
    terms_.push_back(std::move(kept));
  }
  Orthonormal factors = orthonormal(std::move(all));
  r_ = std::move(factors.r);
  first = 0;
  for (Term& term : terms_) {
    term.q = factors.q.middleRows(first, term.targets.size());
    first += term.targets.size();
  }
  given_ = VectorXc::Zero(n);
  given_square_ = 0;
  reset();
}

void AlternatingFit::set_targets(size_t term, const VectorXc& targets) {
  check(!terms_[term].project, "alternating fit: given targets do not move");
  terms_[term].targets = targets;
  given_.setZero();
  given_square_ = 0;
  for (const Term& given : terms_) {
    if (given.project || given.targets.isZero(0)) continue;
    given_ += given.scale * (given.q.adjoint() * given.targets);
    given_square_ += given.scale * given.scale * given.targets.squaredNorm();
  }
}

void AlternatingFit::reset() {
  g_ = VectorXc::Zero(r_.cols());
}

void AlternatingFit::reset(const VectorXc& unknowns) {
  g_ = r_.triangularView<Eigen::Upper>() * unknowns;
}

void AlternatingFit::start(const VectorXc& first_targets) {
  resume();
  terms_[0].targets = first_targets;
  evaluate(zeroth());
}

VectorXc AlternatingFit::unknowns() const {
  return r_.triangularView<Eigen::Upper>().solve(g_);
}

double AlternatingFit::distance(size_t term) const {
  const Term& moving = terms_[term];
  return std::sqrt((moving.values - moving.targets).squaredNorm() /
                   static_cast<double>(moving.values.size()));
}

/// Computes values, targets and energy at g. The energy is clamped to at least its rounding error.
void AlternatingFit::evaluate(const VectorXc& g) {
  g_ = g;
  energy_ = g.squaredNorm() - 2 * given_.dot(g).real() + given_square_;
  for (Term& term : terms_) {
    if (!term.project) continue;
    term.values.noalias() = term.q * g;
    energy_ -= term.values.squaredNorm();
    term.values /= term.scale;
    term.project(term.values, term.targets);
    energy_ += term.scale * term.scale * (term.values - term.targets).squaredNorm();
  }
  energy_ = std::max(energy_, 1e-15 * g_.squaredNorm());
}

VectorXc AlternatingFit::zeroth() const {
  VectorXc g = given_;
  for (const Term& term : terms_)
    if (term.project) g.noalias() += term.q.adjoint() * (term.scale * term.targets);
  return g;
}

/// The combination of the last iterates whose predicted change is smallest (Anderson 1965).
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
  // The coefficients are real because the targets are not a complex-linear function of the map.
  MatrixXd differences(2 * change.size(), m);
  for (Index i = 0; i < m; ++i)
    differences.col(i) = stacked(memory_.change[static_cast<size_t>(i + 1)] -
                                 memory_.change[static_cast<size_t>(i)]);
  const VectorXd weights = pivoted_least_squares(differences, stacked(change));
  VectorXc mixed = next;
  for (Index i = 0; i < m; ++i)
    mixed -=
        weights[i] * (memory_.g[static_cast<size_t>(i + 1)] - memory_.g[static_cast<size_t>(i)]);
  return mixed;
}

/// Lets targets slide along their curves (SB16 eq. 13): tangential distances have only the weight
/// kAlong. The matrix is M = I - (1 - kAlong) A^T A, where A is the real form of the tangential
/// components of the rows of Q.
VectorXc AlternatingFit::first_order() const {
  const Index n = r_.cols();
  MatrixXd m = MatrixXd::Identity(2 * n, 2 * n);
  VectorXd right = stacked(zeroth());
  for (const Term& term : terms_) {
    if (!term.normals) continue;
    VectorXc normals(term.values.size());
    term.normals(term.values, term.targets, normals);
    // Value and target may differ along the tangent i n.
    MatrixXd along(2 * n, normals.size());
    for (Index i = 0; i < normals.size(); ++i) {
      const Complex tangent = std::conj(kI * normals[i]);
      along.col(i).head(n) = (tangent * term.q.row(i)).real().transpose();
      along.col(i).tail(n) = -(tangent * term.q.row(i)).imag().transpose();
    }
    const VectorXd wanted =
        term.scale * (term.targets.array() * (kI * normals.array()).conjugate()).real().matrix();
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

void AlternatingFit::resume() {
  memory_ = {};
  evaluate(VectorXc(g_));
}

int AlternatingFit::run(Mode mode, double settled, int most, const std::function<void()>& see) {
  see();
  for (int steps = 0; steps < most;) {
    const double before = energy_;
    step(mode);
    ++steps;
    see();
    if (before - energy_ <= settled * before) return steps;
  }
  return most;
}

}  // namespace holomorph
