// The unknowns of Psi' are real: (Re, Im) of the whitened coefficients of Psi'.
#include "core/bounded/psi_space.h"

#include "core/error.h"
#include "core/solvers/products.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr double kRoom = 0.01;  ///< fraction of the stretch bounds to leave free for Psi'

BoundedSettings first_step(BoundedSettings settings) {
  settings.bounds.check_usable();
  if (settings.bounds.k > 0) settings.bounds = settings.bounds.tightened(kRoom);
  settings.bounds.k = 0;
  return settings;
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
      distance_(*basis, points, settings.weight),
      pins_(std::move(pins.psi)),
      pin_weight_(pins.weight),
      size_(pins.size) {
  check(pins_.rows() == 0 || pins_.cols() == basis->unknowns(), "pins: a column for each unknown");
  if (pins_.rows() > 0) pins_ = (pins_.rowwise() - pins_.colwise().mean()).eval() / size_;
  disks_.height.resize(0, 0);
  real_columns(basis->at_samples(), disks_.re, disks_.im);
  disks_.quadratic = distance_.quadratic();
  MatrixXd re, im;
  if (pins_.rows() > 0) {
    real_columns(pins_, re, im);
    disks_.quadratic += pin_weight_ * (self_product(re) + self_product(im));
  }
  real_columns(distance_.boundary().rows(), re, im);
  dirichlet_ = ShortestLeastSquares(re.transpose());
}

std::vector<Cone> PsiSpace::disks(const VectorXd& u) const {
  const Eigen::ArrayXd size = u.array().exp();
  return {{tight_.Sigma - size, 0, 0}, {size - tight_.sigma, 0, 0}, {tight_.k * size, 0, 0}};
}

BoundedMap PsiSpace::conformal(const BoundedReference& reference, const BoundedMap* warm) const {
  return conformal_.nearest(reference, warm);
}

ConeTarget PsiSpace::target_of(const BoundedReference& reference, const VectorXc& wanted) const {
  const auto psi = distance_.target(reference.psi, reference.inner_psi, settings_.bounds.Sigma);
  ConeTarget target;
  target.linear = psi.linear;
  target.constant = psi.constant;
  if (pins_.rows() > 0) {
    const VectorXc centered = (wanted.array() - wanted.mean()).matrix() / size_;
    target.linear -= pin_weight_ * stacked(adjoint_product(pins_, centered));
    target.constant += 0.5 * pin_weight_ * centered.squaredNorm();
  }
  return target;
}

void PsiSpace::append_disks(const Points& points, const VectorXc& l, ConeSystem& system) const {
  const MatrixXc c = basis_->values(points);
  const std::vector<Cone> more = disks(product(c, l).real());
  MatrixXd re, im;
  real_columns(basis_->whitened(c), re, im);
  append_columns(re, system.re);
  append_columns(im, system.im);
  for (size_t k = 0; k < more.size(); ++k) {
    VectorXd& offset = system.cones[k].offset;
    const Index before = offset.size();
    offset.conservativeResize(before + c.rows());
    offset.tail(c.rows()) = more[k].offset;
  }
}

BoundedMap PsiSpace::nearest(const BoundedMap& conformal, const BoundedReference& reference,
                             const VectorXc& wanted, const BoundedMap* warm) const {
  const VectorXc& l = conformal.map.l;
  // If the bounds on l are proved, the disks have positive radii everywhere on the boundary.
  if (settings_.bounds.k == 0 || !conformal.certificate.holds) return conformal;
  ConeSystem system = disks_;
  system.cones = disks(product(conformal_.certifier().coordinates(), l).real());
  const VectorXd center = VectorXd::Zero(system.unknowns());
  const CertifiedProgram program{
      conformal_.certifier(),
      settings_.bounds,
      system,
      center,
      [&](const VectorXd& x) {
        return LogMap{l, basis_->coefficients(complex_of(x)), LogMap::Second::psi};
      },
      [&](const Points& points, ConeSystem& cut) { append_disks(points, l, cut); }};
  ConeSolution start;
  start.x = center;
  if (warm && warm->solution.x.size() == center.size())
    for (double fraction = 0.98; fraction > 0.5; fraction *= 0.9)
      if (is_feasible(system, fraction * warm->solution.x)) {
        start.x = fraction * warm->solution.x;
        break;
      }
  return program.solved(target_of(reference, wanted), settings_for(warm), start,
                        CertifiedProgram::cuts_of(warm));
}

BoundedReference PsiSpace::convexified(const BoundedReference& reference) const {
  const MatrixXc &boundary = distance_.boundary().rows(), &inner = distance_.inner();
  const Index m = boundary.rows(), n = boundary.cols();
  const bool bends = settings_.bounds.k > 0;
  ConeSystem convex;
  convex.height = MatrixXd::Identity(m, m);
  convex.re.resize(0, m);
  if (bends) real_columns(boundary, convex.re, convex.im);
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
    convex.quadratic.bottomRightCorner(2 * n, 2 * n) = distance_.quadratic();
    target.linear.tail(2 * n) =
        distance_.target(reference.psi, reference.inner_psi, settings_.bounds.Sigma).linear;
  }
  const VectorXd x = solved(convex, target, settings_for(nullptr), start).x;
  BoundedReference nearest = reference;
  const VectorXd u = x.head(m).array().log();
  const VectorXc fitted = product(boundary, complex_of(dirichlet_.solve(u)));
  const double turn = (reference.log_fz.imag() - fitted.imag()).mean();
  nearest.log_fz.real() = u;
  nearest.log_fz.imag() = fitted.imag().array() + turn;
  if (bends) {
    const VectorXc unknowns = complex_of(x.tail(2 * n));
    nearest.psi = product(boundary, unknowns);
    nearest.inner_psi = product(inner, unknowns);
  }
  return nearest;
}

}  // namespace holomorph
