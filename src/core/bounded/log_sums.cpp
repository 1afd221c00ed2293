#include "core/bounded/log_sums.h"

#include <algorithm>

#include "core/solvers/products.h"

namespace holomorph {

bool LogSum::is_nu() const {
  return std::ranges::all_of(
      terms, [](const auto& term) { return term.second->second == LogMap::Second::nu; });
}

LogMap LogSum::single() const {
  LogMap map = change;
  for (const auto& [weight, term] : terms) {
    map.l += weight * term->l;
    map.w += weight * term->w;
  }
  return map;
}

Derivatives LogSum::at(const MatrixXc& c) const {
  if (is_nu()) {
    const LogMap map = single();
    return derivatives_of(map, c * map.l, c * map.w);
  }
  VectorXc l = c * change.l, nu = c * change.w;
  for (const auto& [weight, term] : terms) {
    const VectorXc own = c * term->l;
    VectorXc w = c * term->w;
    if (term->second == LogMap::Second::psi) w.array() *= (-own.array()).exp();
    l += weight * own;
    nu += weight * w;
  }
  Derivatives d;
  d.phi = l.array().exp();
  d.psi = nu.cwiseProduct(d.phi);
  return d;
}

LogSums::LogSums(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
                 const Points& stations)
    : basis_(std::move(basis)),
      mesh_(std::move(mesh)),
      certifier_(*basis_),
      on_mesh_(*basis_, *mesh_),
      loops_(*mesh_, basis_->polygon()),
      integrals_(*basis_, *mesh_, stations, loops_.paths()),
      size_(box_of(mesh_->vertices).diagonal()) {}

LogSum LogSums::of(std::vector<std::pair<double, const LogMap*>> terms) const {
  return {std::move(terms), {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())}};
}

double LogSums::norm(const LogSum& sum) const {
  const LogMap map = sum.single();
  const MatrixXc& c = certifier_.coordinates();
  return std::sqrt(((c * map.l).squaredNorm() + (c * map.w).squaredNorm()) /
                   static_cast<double>(c.rows()));
}

bool LogSums::certify(const LogSum& sum, const Extremes& within, double growth) const {
  constexpr double kTolerance = 0.01, kRounding = 1e-9;
  constexpr int kDepth = 16;
  const Bounds bounds{std::min(1 - kRounding, (1 + kTolerance) * within.shear + kRounding),
                      (1 - kTolerance) * within.smallest, (1 + growth) * within.largest};
  if (sum.is_nu()) return certifier_.certify(sum.single(), bounds, kDepth).holds;
  if (sum.change.l.isZero(0) && sum.change.w.isZero(0)) return true;
  // The terms alone may exceed the largest size by the largest (1 + t) / 2^t with t from 0 to 1.
  constexpr double kBulge = 0.0615;
  const Extremes change = certifier_.extremes(sum.change);
  return change.shear <= 0.5 * kTolerance * std::min(bounds.k, 1 - bounds.k) &&
         change.smallest >= 1 - 0.5 * kTolerance * (1 - bounds.k) &&
         (1 + kBulge) * change.largest <= 1 + growth;
}

/// Phi' and Psi' at the nodes of the paths, times the weights of the nodes.
Derivatives LogSums::weighted(const LogSum& sum) const {
  Derivatives d = sum.at(integrals_.values());
  d.phi.array() *= integrals_.weights().array();
  d.psi.array() *= integrals_.weights().array();
  return d;
}

VectorXc LogSums::integrals(const LogSum& sum) const {
  const Derivatives d = weighted(sum);
  return integrals_.of(d.phi, d.psi);
}

MapOnMesh::Values LogSums::on_mesh(const LogSum& sum) const {
  if (sum.is_nu()) return on_mesh_.values(sum.single());
  VectorXc l = on_mesh_.function(sum.change.l), l1 = on_mesh_.slope(sum.change.l),
           nu = on_mesh_.function(sum.change.w), nu1 = on_mesh_.slope(sum.change.w);
  for (const auto& [weight, term] : sum.terms) {
    const VectorXc own = on_mesh_.function(term->l), own1 = on_mesh_.slope(term->l);
    VectorXc w = on_mesh_.function(term->w), w1 = on_mesh_.slope(term->w);
    if (term->second == LogMap::Second::psi) {  // nu = Psi' e^-l
      const VectorXc over = (-own.array()).exp();
      w1 = (w1 - w.cwiseProduct(own1)).cwiseProduct(over).eval();
      w = w.cwiseProduct(over).eval();
    }
    l += weight * own;
    l1 += weight * own1;
    nu += weight * w;
    nu1 += weight * w1;
  }
  MapOnMesh::Values values;
  values.first.phi = l.array().exp();
  values.first.psi = nu.cwiseProduct(values.first.phi);
  const VectorXc phi2 = l1.cwiseProduct(values.first.phi),
                 psi2 = (nu1 + nu.cwiseProduct(l1)).cwiseProduct(values.first.phi);
  values.f = on_mesh_.tree().antiderivative(values.first.phi, phi2) +
             on_mesh_.tree().antiderivative(values.first.psi, psi2).conjugate();
  return values;
}

VectorXc LogSums::without_jumps(VectorXc f, const VectorXc& gaps) const {
  if (gaps.size() > 0) f -= loops_.correction(on_mesh_.tree(), gaps);
  return f;
}

LogMap LogSums::change(const Constraints& kept, LogSum sum, bool conformal) const {
  constexpr int kSteps = 3, kMostSteps = 8;
  constexpr double kClosed = 1e-8;  // of the size
  for (int step = 0; step < kMostSteps && kept.combinations.rows() > 0; ++step) {
    const Derivatives d = weighted(sum);
    const VectorXc off = kept.targets - kept.combinations * integrals_.of(d.phi, d.psi);
    if (step >= kSteps && off.cwiseAbs().maxCoeff() <= kClosed * size_) break;
    const LogMap more =
        integrals_.smallest({kept.combinations, off, LogMap::Second::nu, conformal}, *basis_, d);
    sum.change.l += more.l;
    sum.change.w += more.w;
  }
  return sum.change;
}

LogMap LogSums::bounded_change(const Constraints& kept, LogSum sum, const Extremes& bounds,
                               bool conformal) const {
  constexpr int kSteps = 12;
  constexpr double kNone = 1e-9, kClose = 1e-7;
  const MatrixXc &c = certifier_.coordinates(), &whitened = basis_->at_samples();
  std::vector<Index> sized, sheared;
  // Adds the samples that exceed a bound by more than their neighbors do.
  const auto add_worst = [](const Eigen::ArrayXd& excess, std::vector<Index>& samples) {
    for (Index i = 0, n = excess.size(); i < n; ++i)
      if (excess[i] > kClose && excess[i] >= excess[(i + 1) % n] &&
          excess[i] > excess[(i + n - 1) % n] && std::ranges::find(samples, i) == samples.end())
        samples.push_back(i);
  };
  for (int step = 0; step < kSteps && kept.combinations.rows() > 0; ++step) {
    const LogMap map = sum.single();
    const VectorXc l = product(c, map.l), nu = product(c, map.w);
    const Eigen::ArrayXd length = nu.array().abs().max(kNone);
    const Eigen::ArrayXd too_small = std::log(bounds.smallest) - l.real().array() -
                                     (1 - length).max(kNone).log(),
                         too_sheared = length - bounds.shear;
    const Derivatives d = weighted(sum);
    TreeIntegrals::Change asked{kept.combinations,
                                kept.targets - kept.combinations * integrals_.of(d.phi, d.psi),
                                LogMap::Second::nu, conformal};
    if (std::max({too_small.maxCoeff(), too_sheared.maxCoeff(),
                  asked.wanted.cwiseAbs().maxCoeff() / size_}) <= kClose)
      break;
    add_worst(too_small, sized);
    if (!conformal) add_worst(too_sheared, sheared);
    const Index sizes = static_cast<Index>(sized.size()),
                shears = static_cast<Index>(sheared.size());
    asked.rows_l = MatrixXc::Zero(sizes + shears, whitened.cols());
    asked.rows_w = asked.rows_l;
    asked.gains.resize(sizes + shears);
    for (Index k = 0; k < sizes + shears; ++k) {
      const bool is_size = k < sizes;
      const Index i =
          is_size ? sized[static_cast<size_t>(k)] : sheared[static_cast<size_t>(k - sizes)];
      const Complex outward = std::conj(nu[i]) / length[i];
      if (is_size) asked.rows_l.row(k) = whitened.row(i);
      if (!conformal)
        asked.rows_w.row(k) =
            whitened.row(i) * (is_size ? -outward / std::max(1 - length[i], kNone) : outward);
      asked.gains[k] = is_size ? too_small[i] : -too_sheared[i];
    }
    const LogMap more = integrals_.smallest(asked, *basis_, d);
    sum.change.l += more.l;
    sum.change.w += more.w;
  }
  return sum.change;
}

}  // namespace holomorph
