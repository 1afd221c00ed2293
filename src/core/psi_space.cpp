// Unknowns of Psi' are real: (Re, Im) of its whitened coefficients.
#include "core/psi_space.h"

#include <algorithm>

#include "core/error.h"
#include "core/real_form.h"

namespace holomorph {
namespace {

constexpr double kTightening = 0.002;
constexpr double kRoom = 0.01;  ///< of the bounds on stretch, for Psi'

BoundedSettings first_step(BoundedSettings settings) {
  settings.bounds.check_usable();
  settings.bounds = settings.bounds.tightened(kRoom);
  settings.bounds.k = 0;
  return settings;
}

MatrixXd mean_square(const MatrixXc& rows) {
  MatrixXd re, im;
  real_columns(rows, re, im);
  return (re * re.transpose() + im * im.transpose()) /
         static_cast<double>(std::max<Index>(rows.rows(), 1));
}

/// Values beyond what any map within the bounds has, and what is not finite, say a direction only.
VectorXc clamped(const VectorXc& psi, double most) {
  VectorXc result = psi;
  for (Complex& w : result) {
    const double size = std::abs(w);
    if (!std::isfinite(size))
      w = 0;
    else if (size > most)
      w *= most / size;
  }
  return result;
}

void append_column(const VectorXd& column, MatrixXd& to) {
  to.conservativeResize(Eigen::NoChange, to.cols() + 1);
  to.col(to.cols() - 1) = column;
}

ConeSettings settings_for(const BoundedMap* warm) {
  ConeSettings settings;
  settings.gap = warm ? 1e-3 : 1e-4;
  settings.residual = 1e-3;
  settings.neglected = 0.1;
  return settings;
}

}  // namespace

PsiSpace::PsiSpace(std::shared_ptr<const BoundaryBasis> basis, const ReferencePoints& points,
                   const BoundedSettings& settings, PinRows pins)
    : basis_(basis),
      settings_(settings),
      tight_(settings.bounds.tightened(kTightening)),
      conformal_(basis, points, first_step(settings)),
      boundary_(basis->whitened(basis->values(points.boundary))),
      inner_(basis->whitened(basis->values(points.inner))),
      pins_(std::move(pins.psi)),
      pin_weight_(pins.weight),
      size_(pins.size) {
  check(pins_.rows() == 0 || pins_.cols() == basis->size(), "pins: a column for each unknown");
  if (pins_.rows() > 0) pins_ = (pins_.rowwise() - pins_.colwise().mean()).eval() / size_;
  take_distance();
  discs_.height.resize(0, 0);
  real_columns(basis->at_samples(), discs_.re, discs_.im);
  discs_.quadratic = distance_;
  if (pins_.rows() > 0)
    discs_.quadratic += pin_weight_ * static_cast<double>(pins_.rows()) * mean_square(pins_);
  MatrixXd re, im;
  real_columns(boundary_, re, im);
  dirichlet_.compute(re.transpose());
}

void PsiSpace::take_distance() {
  const double share = inner_.rows() > 0 ? 0.5 : 1;
  distance_ = settings_.weight * share * mean_square(boundary_);
  if (inner_.rows() > 0) distance_ += settings_.weight * share * mean_square(inner_);
}

VectorXd PsiSpace::psi_linear(const BoundedReference& reference) const {
  check(reference.psi.size() == boundary_.rows() && reference.inner_psi.size() == inner_.rows(),
        "bounded reference: one value for each sample");
  const double share = inner_.rows() > 0 ? 0.5 : 1, most = settings_.bounds.Sigma;
  const auto part = [&](const MatrixXc& rows, const VectorXc& psi) -> VectorXd {
    return -settings_.weight * share / static_cast<double>(rows.rows()) *
           stacked(rows.adjoint() * clamped(psi, most));
  };
  VectorXd linear = part(boundary_, reference.psi);
  if (inner_.rows() > 0) linear += part(inner_, reference.inner_psi);
  return linear;
}

std::vector<Cone> PsiSpace::discs(const VectorXd& u) const {
  const Eigen::ArrayXd size = u.array().exp();
  return {{tight_.Sigma - size, 0, 0}, {size - tight_.sigma, 0, 0}, {tight_.k * size, 0, 0}};
}

BoundedMap PsiSpace::conformal(const BoundedReference& reference, const BoundedMap* warm) const {
  return conformal_.nearest(reference, warm);
}

BoundedMap PsiSpace::nearest(const BoundedMap& conformal, const BoundedReference& reference,
                             const VectorXc& wanted, const BoundedMap* warm) const {
  const VectorXc& l = conformal.map.l;
  if (settings_.bounds.k == 0) return conformal;
  ConeSystem system = discs_;
  system.cones = discs((conformal_.certifier().coordinates() * l).real());
  ConeTarget target;
  target.linear = psi_linear(reference);
  if (pins_.rows() > 0) {
    const VectorXc centred = (wanted.array() - wanted.mean()).matrix() / size_;
    target.linear -= pin_weight_ * stacked(pins_.adjoint() * centred);
    target.constant = 0.5 * pin_weight_ * centred.squaredNorm();
  }
  const VectorXd centre = VectorXd::Zero(system.unknowns());
  const CertifiedProgram program{
      conformal_.certifier(),
      settings_.bounds,
      system,
      centre,
      [&](const VectorXd& x) {
        return LogMap{l, basis_->coefficients(complex_of(x)), LogMap::Second::psi};
      },
      [&](const Points& points, ConeSystem& cut) {
        const MatrixXc c = basis_->values(points);
        const std::vector<Cone> more = discs((c * l).real());
        MatrixXd re, im;
        real_columns(basis_->whitened(c), re, im);
        for (Index i = 0; i < c.rows(); ++i) {
          // Between samples |f_z| may have used up what the bounds are tightened by.
          const auto is_open = [&](const Cone& cone) { return cone.offset[i] > 0; };
          if (!std::ranges::all_of(more, is_open)) continue;
          append_column(re.col(i), cut.re);
          append_column(im.col(i), cut.im);
          for (size_t k = 0; k < more.size(); ++k) {
            VectorXd& offset = cut.cones[k].offset;
            offset.conservativeResize(offset.size() + 1);
            offset[offset.size() - 1] = more[k].offset[i];
          }
        }
      }};
  ConeSolution start;
  start.x = centre;
  if (warm && warm->solution.x.size() == centre.size())
    for (double share = 0.98; share > 0.5; share *= 0.9)
      if (is_feasible(system, share * warm->solution.x)) {
        start.x = share * warm->solution.x;
        break;
      }
  return program.solved(target, settings_for(warm), start, CertifiedProgram::cuts_of(warm));
}

BoundedReference PsiSpace::convexified(const BoundedReference& reference) const {
  const Index m = boundary_.rows(), n = boundary_.cols();
  const bool bends = settings_.bounds.k > 0;
  ConeSystem convex;
  convex.height = MatrixXd::Identity(m, m);
  convex.re.resize(0, m);
  if (bends) real_columns(boundary_, convex.re, convex.im);
  const auto same = [](double offset) { return VectorXd::Constant(1, offset); };
  convex.cones = {{same(tight_.Sigma), -1, 0}, {same(-tight_.sigma), 1, 0}};
  if (bends) convex.cones.push_back({same(0), tight_.k, 0});
  const Index all = convex.unknowns();
  convex.quadratic = MatrixXd::Zero(all, all);
  convex.quadratic.diagonal().head(m).setConstant(1 / static_cast<double>(m));
  convex.fit.resize(m, 0);
  ConeTarget target;
  target.linear = VectorXd::Zero(all);
  target.linear.head(m) =
      -reference.log_fz.real().array().exp().min(settings_.bounds.Sigma) / static_cast<double>(m);
  ConeSolution start;
  start.x = VectorXd::Zero(all);
  start.x.head(m).setConstant(0.5 * (tight_.sigma + tight_.Sigma));
  if (bends) {
    convex.quadratic.bottomRightCorner(2 * n, 2 * n) = distance_;
    target.linear.tail(2 * n) = psi_linear(reference);
  }
  const VectorXd x = solved(convex, target, settings_for(nullptr), start).x;
  BoundedReference nearest = reference;
  const VectorXd u = x.head(m).array().log();
  const VectorXc fitted = boundary_ * complex_of(dirichlet_.solve(u));
  const double turn = (reference.log_fz.imag() - fitted.imag()).mean();
  nearest.log_fz.real() = u;
  nearest.log_fz.imag() = fitted.imag().array() + turn;
  if (bends) {
    const VectorXc unknowns = complex_of(x.tail(2 * n));
    nearest.psi = boundary_ * unknowns;
    nearest.inner_psi = inner_ * unknowns;
  }
  return nearest;
}

}  // namespace holomorph
