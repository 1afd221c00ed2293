#include "core/bounded/log_inbetween.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/mesh/inbetween.h"
#include "core/solvers/products.h"

namespace holomorph {
namespace {

/// The value of smooth motion from 0 to 1 that starts and ends at rest.
double smoothstep(double u) {
  return u * u * (3 - 2 * u);
}

LogMap between(const LogMap& a, const LogMap& b, double part) {
  return {(1 - part) * a.l + part * b.l, (1 - part) * a.w + part * b.w};
}

}  // namespace

LogInbetween::LogInbetween(std::shared_ptr<const BoundaryBasis> basis,
                           std::shared_ptr<const Mesh> mesh, const Points& stations)
    : basis_(std::move(basis)),
      mesh_(std::move(mesh)),
      certifier_(*basis_),
      on_mesh_(*basis_, *mesh_),
      loops_(*mesh_, basis_->polygon()),
      integrals_(*basis_, *mesh_, stations, loops_.paths()),
      stations_(stations),
      locator_(*mesh_),
      size_(box_of(mesh_->vertices).diagonal()) {}

bool LogInbetween::is_nu(const Sum& sum) {
  return std::ranges::all_of(
      sum.terms, [](const auto& term) { return term.second->second == LogMap::Second::nu; });
}

/// The sum as a single map, if all terms are in L_nu.
LogMap LogInbetween::single(const Sum& sum) {
  LogMap map = sum.change;
  for (const auto& [weight, term] : sum.terms) {
    map.l += weight * term->l;
    map.w += weight * term->w;
  }
  return map;
}

LogInbetween::Sum LogInbetween::sum_of(const std::array<const Key*, 4>& keys,
                                       const std::array<double, 4>& weights) const {
  Sum sum{{}, {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())}};
  for (size_t k = 0; k < keys.size(); ++k)
    if (keys[k] && weights[k] != 0) sum.terms.push_back({weights[k], &keys[k]->map});
  return sum;
}

Derivatives LogInbetween::weighted(const Sum& sum) const {
  const MatrixXc& c = integrals_.values();
  VectorXc l = c * sum.change.l, nu = c * sum.change.w;
  for (const auto& [weight, term] : sum.terms) {
    const VectorXc own = c * term->l;
    VectorXc w = c * term->w;
    if (term->second == LogMap::Second::psi) w.array() *= (-own.array()).exp();
    l += weight * own;
    nu += weight * w;
  }
  Derivatives d;
  d.phi = l.array().exp() * integrals_.weights().array();
  d.psi = nu.cwiseProduct(d.phi);
  return d;
}

MapOnMesh::Values LogInbetween::on_mesh(const Sum& sum) const {
  if (is_nu(sum)) return on_mesh_.values(single(sum));
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

/// Tries to prove the extremes of the given keys, with a tolerance of 1 %. If a term is in L_psi,
/// its nu is not in the basis. By convexity, the terms alone stay within the extremes, and only the
/// change has to be small.
bool LogInbetween::certify(const Sum& sum, std::span<const Key* const> within,
                           double growth) const {
  constexpr double kTolerance = 0.01, kRounding = 1e-9;
  constexpr int kDepth = 8;
  Bounds bounds{0, std::numeric_limits<double>::infinity(), 0};
  for (const Key* key : within) {
    bounds.k = std::max(bounds.k, key->extremes.shear);
    bounds.sigma = std::min(bounds.sigma, key->extremes.smallest);
    bounds.Sigma = std::max(bounds.Sigma, (1 + growth) * key->extremes.largest);
  }
  bounds.k = std::min(1 - kRounding, (1 + kTolerance) * bounds.k + kRounding);
  bounds.sigma *= 1 - kTolerance;
  if (is_nu(sum)) return certifier_.certify(single(sum), bounds, kDepth).holds;
  if (sum.change.l.isZero(0) && sum.change.w.isZero(0)) return true;
  const Extremes change = certifier_.extremes(sum.change);
  return change.shear <= 0.5 * kTolerance * bounds.k &&
         change.smallest >= 1 - 0.5 * kTolerance * (1 - bounds.k) && change.largest <= 1 + growth;
}

/// The root mean square of l and nu on the boundary.
double LogInbetween::norm(const Sum& sum) const {
  const LogMap map = single(sum);
  const MatrixXc& c = certifier_.coordinates();
  return std::sqrt(((c * map.l).squaredNorm() + (c * map.w).squaredNorm()) /
                   static_cast<double>(c.rows()));
}

double LogInbetween::distance(const Key& a, const Key& b) const {
  return norm({{{-1, &a.map}, {1, &b.map}},
               {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())}});
}

/// The derivative at key `at`, as weights of the keys: that of the parabola through the key and its
/// two neighbors. It is halved until the inner points of both Bezier curves at the key certify; 0
/// if a neighbor is missing.
std::array<double, 4> LogInbetween::velocity(const std::array<const Key*, 4>& keys,
                                             size_t at) const {
  const Key *before = keys[at - 1], *here = keys[at], *after = keys[at + 1];
  if (!before || !after) return {};
  for (const Key* key : {before, here, after})
    if (key->map.second != LogMap::Second::nu) return {};
  const double h0 = here->time - before->time, h1 = after->time - here->time;
  std::array<double, 4> velocity{};
  velocity[at - 1] = -h1 / (h0 * (h0 + h1));
  velocity[at + 1] = h0 / (h1 * (h0 + h1));
  velocity[at] = -velocity[at - 1] - velocity[at + 1];
  // Where the picture rests before or after the key, it must not move. Elsewhere this does not
  // matter (compare Fritsch, Carlson 1980).
  const double most = 3 * std::min(distance(*before, *here) / h0, distance(*here, *after) / h1);
  const double speed = norm(sum_of(keys, velocity));
  if (speed > most)
    for (double& weight : velocity) weight *= most / speed;
  const auto certifies = [&](double step, const Key* other) {
    std::array<double, 4> weights{};
    for (size_t k = 0; k < 4; ++k) weights[k] = step * velocity[k] + (k == at ? 1 : 0);
    constexpr double kRoom = 0.1;  // less than kGrowth, because curves may bulge
    return certify(sum_of(keys, weights), std::array{here, other}, kRoom);
  };
  constexpr int kHalvings = 4;
  for (int halving = 0; halving < kHalvings; ++halving) {
    if (certifies(-h0 / 3, before) && certifies(h1 / 3, after)) return velocity;
    for (double& weight : velocity) weight *= 0.5;
  }
  return {};
}

double LogInbetween::slide(const Key& from, const Key& to, const std::vector<char>& held) const {
  const LogMap none{VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())};
  const auto integrals = [&](std::vector<std::pair<double, const LogMap*>> terms) {
    const Derivatives d = weighted({std::move(terms), none});
    return integrals_.of(d.phi, d.psi);
  };
  const VectorXc off = integrals({{0.5, &from.map}, {0.5, &to.map}}) -
                       0.5 * (integrals({{1, &from.map}}) + integrals({{1, &to.map}}));
  double most = 0;
  std::optional<Complex> first;
  for (size_t i = 0; i < held.size(); ++i) {  // integrals start at station 0
    if (!held[i]) continue;
    const Complex here = i == 0 ? Complex(0) : off[static_cast<Index>(i) - 1];
    if (first) most = std::max(most, std::abs(here - *first));
    if (!first) first = here;
  }
  return most;
}

LogInbetween::Interval LogInbetween::interval(const Key* before, const Key& from, const Key& to,
                                              const Key* after, bool smooth,
                                              const std::vector<char>& held) const {
  check(static_cast<Index>(held.size()) == static_cast<Index>(stations_.size()),
        "in-between: one mark for each station");
  Interval interval;
  interval.owner = this;
  interval.smooth = smooth;
  interval.keys = {before, &from, &to, after};
  interval.controls[0][1] = interval.controls[1][1] = 1;
  interval.controls[2][2] = interval.controls[3][2] = 1;
  if (smooth) {
    const double third = (to.time - from.time) / 3;
    const auto start = velocity(interval.keys, 1), end = velocity(interval.keys, 2);
    for (size_t k = 0; k < 4; ++k) {
      interval.controls[1][k] += third * start[k];
      interval.controls[2][k] -= third * end[k];
    }
  }
  interval.conformal = from.map.w.isZero(0) && to.map.w.isZero(0);
  const auto place = [&](Complex z) {
    const int vertex = locator_.vertex_near(z);
    interval.anchors.push_back(vertex);
    interval.placed.push_back({mesh_->vertices[static_cast<size_t>(vertex)], z});
  };
  std::vector<Index>& still = interval.still;
  for (size_t i = 0; i < stations_.size(); ++i) {
    if (!held[i]) continue;
    still.push_back(static_cast<Index>(i));
    place(stations_[i]);
  }
  if (still.empty()) place(least_moving_point(*mesh_, from.f, to.f).in(*mesh_, mesh_->vertices));
  const Index pairs = std::max<Index>(0, static_cast<Index>(still.size()) - 1),
              holes = static_cast<Index>(loops_.paths().size()), count = integrals_.count();
  interval.constant = MatrixXd::Zero(pairs + holes, count);
  for (Index i = 0; i < pairs; ++i) {  // integrals start at station 0
    const Index one = still[static_cast<size_t>(i)], next = still[static_cast<size_t>(i) + 1];
    if (one > 0) interval.constant(i, one - 1) = -1;
    interval.constant(i, next - 1) = 1;
  }
  interval.constant.bottomRightCorner(holes, holes).setIdentity();
  const auto measure = [&](const Key& key, VectorXc& value, VectorXc& off, VectorXc& places) {
    const Sum sum{{{1, &key.map}},
                  {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())}};
    const Derivatives d = weighted(sum);
    const VectorXc integrals = integrals_.of(d.phi, d.psi);
    value = interval.constant * integrals;
    off = key.f - without_jumps(on_mesh(sum).f, integrals.tail(holes));
    places = interval.images(sum, key.f);
  };
  measure(from, interval.at_from, interval.off_from, interval.placed_from);
  measure(to, interval.at_to, interval.off_to, interval.placed_to);
  return interval;
}

VectorXc LogInbetween::without_jumps(VectorXc f, const VectorXc& gaps) const {
  if (gaps.size() > 0) f -= loops_.correction(on_mesh_.tree(), gaps);
  return f;
}

/// The change that gives integrals their targets, by Gauss-Newton steps from the change that
/// the sum has; `conformal`: only l changes.
LogMap LogInbetween::constrained_change(const Kept& kept, Sum sum, bool conformal) const {
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

/// Like constrained_change(), but also keeps |nu| and the size within bounds at the samples of the
/// boundary. Where a sample is outside a bound, its value is prescribed from then on: |nu|, or the
/// logarithm Re l + ln(1 - |nu|) of the size.
LogMap LogInbetween::bounded_change(const Kept& kept, Sum sum, const Extremes& bounds,
                                    bool conformal) const {
  constexpr int kSteps = 12;
  constexpr double kNone = 1e-9, kClose = 1e-7;
  const MatrixXc &c = certifier_.coordinates(), &whitened = basis_->at_samples();
  std::vector<Index> sized, sheared;
  // Adds the samples that exceed a bound by more than their neighbors do.
  const auto add_worst = [](const Eigen::ArrayXd& gain, std::vector<Index>& samples) {
    for (Index i = 0, n = gain.size(); i < n; ++i)
      if (gain[i] > kClose && gain[i] >= gain[(i + 1) % n] && gain[i] > gain[(i + n - 1) % n] &&
          std::ranges::find(samples, i) == samples.end())
        samples.push_back(i);
  };
  for (int step = 0; step < kSteps && kept.combinations.rows() > 0; ++step) {
    const LogMap map = single(sum);
    const VectorXc l = product(c, map.l), nu = product(c, map.w);
    const Eigen::ArrayXd length = nu.array().abs().max(kNone);
    const Eigen::ArrayXd size = std::log(bounds.smallest) - l.real().array() -
                                (1 - length).max(kNone).log(),
                         shear = length - bounds.shear;
    const Derivatives d = weighted(sum);
    TreeIntegrals::Change change{kept.combinations,
                                 kept.targets - kept.combinations * integrals_.of(d.phi, d.psi),
                                 LogMap::Second::nu, conformal};
    if (std::max({size.maxCoeff(), shear.maxCoeff(),
                  change.wanted.cwiseAbs().maxCoeff() / size_}) <= kClose)
      break;
    add_worst(size, sized);
    if (!conformal) add_worst(shear, sheared);
    const Index sizes = static_cast<Index>(sized.size()),
                shears = static_cast<Index>(sheared.size());
    change.rows_l = MatrixXc::Zero(sizes + shears, whitened.cols());
    change.rows_w = change.rows_l;
    change.gains.resize(sizes + shears);
    for (Index k = 0; k < sizes + shears; ++k) {
      const bool is_size = k < sizes;
      const Index i =
          is_size ? sized[static_cast<size_t>(k)] : sheared[static_cast<size_t>(k - sizes)];
      const Complex outward = std::conj(nu[i]) / length[i];
      if (is_size) change.rows_l.row(k) = whitened.row(i);
      change.rows_w.row(k) =
          whitened.row(i) * (is_size ? -outward / std::max(1 - length[i], kNone) : outward);
      change.gains[k] = is_size ? size[i] : -shear[i];
    }
    const LogMap more = integrals_.smallest(change, *basis_, d);
    sum.change.l += more.l;
    sum.change.w += more.w;
  }
  return sum.change;
}

/// Gives the sum a change. Returns whether the keys' extremes are proved for the result.
bool LogInbetween::Interval::certifies(Sum& sum, LogMap change) const {
  sum.change = std::move(change);
  return sum.change.l.allFinite() && sum.change.w.allFinite() &&
         owner->certify(sum, std::span(keys).subspan(1, 2), kGrowth);
}

/// The same for a change that also has to reach its targets.
bool LogInbetween::Interval::certifies(Sum& sum, LogMap change, const Kept& kept) const {
  if (!certifies(sum, std::move(change))) return false;
  const Derivatives d = owner->weighted(sum);
  const VectorXc off = kept.targets - kept.combinations * owner->integrals_.of(d.phi, d.psi);
  return off.size() == 0 || off.cwiseAbs().maxCoeff() <= 0.1 * kStill * owner->size_;
}

/// Starts at several changes between the least one and a change of l alone, which does not increase
/// |nu|. If limits are exceeded between samples, tries limits that are 2 % tighter.
bool LogInbetween::Interval::keeps_within_limits(const Kept& kept, Sum& sum,
                                                 const LogMap& least) const {
  if (kept.combinations.rows() == 0) return false;
  const Sum blended = sum;
  const auto starting_at = [&](const LogMap& change) {
    Sum start = blended;
    start.change = change;
    return start;
  };
  const LogMap alone = conformal ? least : owner->constrained_change(kept, blended, true);
  if (!is_nu(blended))
    return certifies(sum, alone, kept) ||
           (!conformal && certifies(sum,
                                    owner->constrained_change(
                                        kept, starting_at(between(least, alone, 0.5)), false),
                                    kept));
  const double shear = std::max(keys[1]->extremes.shear, keys[2]->extremes.shear),
               smallest = std::min(keys[1]->extremes.smallest, keys[2]->extremes.smallest);
  for (const double part : {0.0, 0.5, 1.0}) {
    if (conformal && part > 0) break;
    for (const double margin : {0.0, 0.02})
      if (certifies(
              sum,
              owner->bounded_change(kept, starting_at(between(least, alone, part)),
                                    {(1 - margin) * shear, (1 + margin) * smallest}, conformal),
              kept))
        return true;
  }
  return false;
}

/// Changes the sum so that stations are where they should be and holes are closed. Returns whether
/// that was possible within the keys' extremes.
bool LogInbetween::Interval::keeps(const Kept& kept, Sum& sum) const {
  const Sum blended = sum;
  const LogMap whole = owner->constrained_change(kept, blended, conformal);
  if (certifies(sum, whole, kept)) return true;
  sum = blended;
  return keeps_within_limits(kept, sum, whole);
}

/// Gives the sum the smallest change that certifies, of those that keep stations still and close
/// holes; or else smaller changes, toward the blend, which certifies. Holes stay closed.
void LogInbetween::Interval::correct(const VectorXc& wanted, Sum& sum, Blend& blend) const {
  const Sum blended = sum;
  const Kept kept{constant, wanted};
  blend.certified = keeps(kept, sum);
  if (blend.certified) return;
  const LogMap whole = owner->constrained_change(kept, blended, conformal);
  const Index holes = static_cast<Index>(owner->loops_.paths().size());
  const Kept closed{constant.bottomRows(holes), wanted.tail(holes)};
  const LogMap least = owner->constrained_change(closed, blended, conformal);
  const auto certifies_part = [&](double part) {
    Sum tried = blended;
    tried.change = between(least, whole, part);
    if (!certifies(tried, owner->constrained_change(closed, tried, conformal))) return false;
    sum = std::move(tried);
    return true;
  };
  constexpr double kLeast = 1e-3;
  double part = 0.5;
  while (part > kLeast && !certifies_part(part)) part *= 0.5;
  blend.certified = part > kLeast || certifies_part(0);
  // The largest part, so that pins do not jump when they start to slide.
  constexpr int kBisections = 4;
  double step = 0.5 * part;
  for (int i = 0; part > kLeast && i < kBisections; ++i, step *= 0.5)
    if (certifies_part(part + step)) part += step;
  if (blend.certified) return;
  sum = blended;
  blend.certified = keeps_within_limits(closed, sum, least);
  if (blend.certified) return;
  sum = blended;
  if (least.l.allFinite() && least.w.allFinite()) sum.change = least;
}

/// Fills in f and its derivatives, and closes what integration leaves open around holes.
void LogInbetween::Interval::draw(const Sum& sum, double share, Blend& blend) const {
  MapOnMesh::Values values = owner->on_mesh(sum);
  blend.first = std::move(values.first);
  blend.f = std::move(values.f);
  if (!owner->loops_.paths().empty()) {
    const Derivatives d = owner->weighted(sum);
    const Index holes = static_cast<Index>(owner->loops_.paths().size());
    const VectorXc gaps = owner->integrals_.of(d.phi, d.psi).tail(holes);
    blend.gap = gaps.cwiseAbs().maxCoeff();
    constexpr double kClosed = 1e-6;
    if (blend.gap > kClosed * owner->size_) blend.certified = false;
    blend.f = owner->without_jumps(std::move(blend.f), gaps);
  }
  blend.f += (1 - share) * off_from + share * off_to;
  blend.f.array() += misses(sum, share, blend.f).mean();
}

/// The images of the placed points by a sum with values f at the mesh's vertices.
VectorXc LogInbetween::Interval::images(const Sum& sum, const VectorXc& f) const {
  if (is_nu(sum)) {
    VectorXc images = increments_along(*owner->basis_, single(sum), placed);
    for (size_t i = 0; i < anchors.size(); ++i) images[static_cast<Index>(i)] += f[anchors[i]];
    return images;
  }
  const Mesh& mesh = *owner->mesh_;
  VectorXc images(static_cast<Index>(placed.size()));
  for (size_t i = 0; i < placed.size(); ++i)
    images[static_cast<Index>(i)] = owner->locator_.near(placed[i].to).in(mesh, as_span(f));
  return images;
}

/// What the placed points miss their straight paths by.
VectorXc LogInbetween::Interval::misses(const Sum& sum, double share, const VectorXc& f) const {
  return (1 - share) * placed_from + share * placed_to - images(sum, f);
}

LogInbetween::Blend LogInbetween::Interval::at(double u, bool measures) const {
  const double v = 1 - u, share = smooth ? smoothstep(u) : u;
  const std::array<double, 4> bernstein =
      smooth ? std::array<double, 4>{v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u}
             : std::array<double, 4>{v, 0, 0, u};
  std::array<double, 4> weights{};
  for (size_t p = 0; p < 4; ++p)
    for (size_t k = 0; k < 4; ++k) weights[k] += bernstein[p] * controls[p][k];
  Sum sum = owner->sum_of(keys, weights);
  Blend blend;
  VectorXc wanted = (1 - share) * at_from + share * at_to;
  correct(wanted, sum, blend);
  draw(sum, share, blend);
  // Integration along the mesh is less accurate, and a pass that gets only partway still helps the
  // next one.
  constexpr int kPasses = 3;
  constexpr double kClose = 0.1 * kStill;
  VectorXc off = misses(sum, share, blend.f);
  for (int pass = 0; pass < kPasses && blend.certified && still.size() > 1; ++pass) {
    if (off.cwiseAbs().maxCoeff() <= kClose * owner->size_) break;
    const Index pairs = off.size() - 1;
    wanted.head(pairs) += off.tail(pairs) - off.head(pairs);
    Sum closer = sum;
    if (!keeps({constant, wanted}, closer)) break;
    Blend better = blend;
    draw(closer, share, better);
    if (!better.certified) break;
    blend = std::move(better);
    sum = std::move(closer);
    off = misses(sum, share, blend.f);
  }
  Index worst = 0;
  if (!still.empty() && off.cwiseAbs().maxCoeff(&worst) > kStill * owner->size_)
    blend.slide = Blend::Slide{still[static_cast<size_t>(worst)], std::abs(off[worst])};
  if (is_nu(sum)) blend.map = single(sum);
  if (measures && blend.certified && blend.map)
    blend.extremes = owner->certifier_.extremes(*blend.map);
  return blend;
}

}  // namespace holomorph
