// The unknowns are real: (Re, Im) of the whitened coefficients of l, followed by those for nu.
#include "core/bounded/bounded_space.h"

#include "core/error.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

/// A draft may be moved this far toward the center to be proved. Lengths change by half a percent.
constexpr double kSlightBlend = 3e-3;

/// Tighter tolerances would make no visible difference. Where a draft needs more iterations, the
/// next one continues.
ConeSettings draft_settings() {
  ConeSettings settings;
  settings.gap = 3e-3;
  settings.relative_gap = 3e-2;
  settings.residual = 1e-2;
  settings.neglected = 0.1;
  settings.iterations = 10;
  settings.first_gap = 0.03;
  return settings;
}

ConeSettings final_settings(BoundedSettings::Norm norm) {
  ConeSettings settings;
  settings.gap = 1e-4;
  settings.relative_gap = 1e-3;
  settings.residual = norm == BoundedSettings::Norm::l1 ? 3e-3 : 1e-3;
  settings.neglected = 0.1;
  return settings;
}

}  // namespace

BoundedSpace::BoundedSpace(std::shared_ptr<const BoundaryBasis> basis,
                           const ReferencePoints& points, const BoundedSettings& settings)
    : basis_(std::move(basis)),
      settings_(settings),
      distance_(*basis_, points, settings.weight),
      certifier_(*basis_) {
  settings.bounds.check_usable();
  const Bounds tight = settings.bounds.tightened(kTightening);
  const Index n = basis_->unknowns();
  const bool conformal = settings.bounds.k == 0;
  system_.re.resize(conformal ? 0 : 2 * n, 0);
  append_samples(basis_->at_samples(), system_);
  const auto same = [](double offset) { return VectorXd::Constant(1, offset); };
  system_.cones = {{same(std::log(tight.Sigma)), -1, 0}, {same(1), 0, tight.sigma}};
  system_.quadratic = MatrixXd::Zero(system_.unknowns(), system_.unknowns());
  if (!conformal) {
    system_.cones.push_back({same(tight.k), 0, 0});
    system_.quadratic.bottomRightCorner(2 * n, 2 * n) = distance_.quadratic();
  }
  set_up_distance_of_l();
  center_ = VectorXd::Zero(system_.unknowns());
  center_.head(2 * n) = stacked(tight.middle() * basis_->one());
}

void BoundedSpace::set_up_distance_of_l() {
  MatrixXd re, im;
  real_columns(distance_.boundary().rows(), re, im);
  const double m = static_cast<double>(re.cols());
  system_.fit.resize(re.rows(), 0);
  if (settings_.norm == BoundedSettings::Norm::l1) {
    system_.fit.resize(re.rows(), 2 * re.cols());
    system_.fit << re, im;
    system_.fit_weight = 1 / m;
  } else {
    system_.quadratic.topLeftCorner(re.rows(), re.rows()) =
        (re * re.transpose() + im * im.transpose()) / m;
  }
}

void BoundedSpace::append_samples(const MatrixXc& whitened, ConeSystem& system) const {
  MatrixXd re, im;
  real_columns(whitened, re, im);
  append_columns(re, system.height);
  if (system.re.rows() == 0) return;  // conformal: nu is 0
  append_columns(re, system.re);
  append_columns(im, system.im);
}

ConeTarget BoundedSpace::target_of(const BoundedReference& reference) const {
  const MatrixXc& rows = distance_.boundary().rows();
  const Index n = basis_->unknowns(), m = rows.rows();
  check(reference.log_fz.size() == m, "bounded reference: one value for each sample");
  ConeTarget target;
  target.linear = VectorXd::Zero(system_.unknowns());
  if (system_.re.rows() > 0) {
    // Where the reference's nu exceeds the bound, only the direction of nu matters.
    const auto nu = distance_.target(reference.nu, reference.inner_nu, settings_.bounds.k);
    target.linear.tail(2 * n) = nu.linear;
    target.constant = nu.constant;
  }
  if (settings_.norm == BoundedSettings::Norm::l1) {
    target.wanted.resize(2 * m);
    target.wanted << reference.log_fz.real(), reference.log_fz.imag();
  } else {
    const double weight = 1 / static_cast<double>(m);
    target.linear.head(2 * n) = -weight * stacked(rows.adjoint() * reference.log_fz);
    target.constant += 0.5 * weight * reference.log_fz.squaredNorm();
  }
  return target;
}

ConeSolution BoundedSpace::start(const BoundedMap* warm) const {
  constexpr double kPull = 0.01;  // room for the first step
  ConeSolution start;
  start.x = center_;
  if (warm && warm->solution.x.size() == center_.size()) {
    const VectorXd x = (1 - kPull) * warm->solution.x + kPull * center_;
    if (is_feasible(system_, x)) {
      start.x = x;
      start.fit_duals = warm->solution.fit_duals;
    }
  }
  return start;
}

VectorXd BoundedSpace::unconstrained(const BoundedReference& reference) const {
  VectorXd x(system_.unknowns());
  const Index n = basis_->unknowns();
  x.head(2 * n) = stacked(distance_.boundary().unknowns(reference.log_fz));
  if (system_.re.rows() > 0) x.tail(2 * n) = stacked(distance_.boundary().unknowns(reference.nu));
  return x;
}

LogMap BoundedSpace::map_of(const VectorXd& x) const {
  const Index n = basis_->unknowns();
  VectorXc nu = VectorXc::Zero(basis_->size());
  if (system_.re.rows() > 0) nu = basis_->coefficients(complex_of(x.tail(2 * n)));
  return {basis_->coefficients(complex_of(x.head(2 * n))), std::move(nu)};
}

double BoundedSpace::energy(const BoundedReference& reference, const ConeSolution& solution) const {
  return energy_of(system_, target_of(reference), solution.x);
}

BoundedMap BoundedSpace::nearest(const BoundedReference& reference, const BoundedMap* warm) const {
  const ConeTarget target = target_of(reference);
  const ConeSettings settings = warm ? draft_settings() : final_settings(settings_.norm);
  const CertifiedProgram program{certifier_,
                                 settings_.bounds,
                                 system_,
                                 center_,
                                 [this](const VectorXd& x) { return map_of(x); },
                                 [this](const Points& points, ConeSystem& system) {
                                   append_samples(basis_->whitened(basis_->values(points)), system);
                                 },
                                 warm ? kSlightBlend : 0};
  const VectorXd best_fit = unconstrained(reference);
  constexpr double kNothing = 1e-9;  // if the space contains the reference, it is the solution
  if (is_feasible(system_, best_fit) && energy_of(system_, target, best_fit) <= kNothing) {
    ConeSolution known;
    known.x = best_fit;
    known.status = ConeSolution::Status::solved;
    return program.proved(target, settings, std::move(known));
  }
  return program.solved(target, settings, start(warm), CertifiedProgram::cuts_of(warm));
}

}  // namespace holomorph
