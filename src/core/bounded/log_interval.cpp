#include "core/bounded/log_interval.h"

#include <algorithm>

#include "core/arithmetic.h"
#include "core/maps/still_pins.h"

namespace holomorph {
namespace {

LogMap between(const LogMap& a, const LogMap& b, double part) {
  return {(1 - part) * a.l + part * b.l, (1 - part) * a.w + part * b.w};
}

VectorXc between(const VectorXc& a, const VectorXc& b, double part) {
  return (1 - part) * a + part * b;
}

/// Differences of the integrals to consecutive stations of `kept`, and the integrals around holes.
MatrixXd constant_combinations(std::span<const Index> kept, Index integrals, Index holes) {
  const Index pairs = std::max<Index>(0, static_cast<Index>(kept.size()) - 1);
  MatrixXd combinations = MatrixXd::Zero(pairs + holes, integrals);
  for (Index i = 0; i < pairs; ++i) {  // integrals start at station 0
    const Index one = kept[static_cast<size_t>(i)], next = kept[static_cast<size_t>(i) + 1];
    if (one > 0) combinations(i, one - 1) = -1;
    combinations(i, next - 1) = 1;
  }
  combinations.bottomRightCorner(holes, holes).setIdentity();
  return combinations;
}

}  // namespace

Extremes extremes_of(const LogKey& a, const LogKey& b) {
  return {std::max(a.extremes.shear, b.extremes.shear),
          std::min(a.extremes.smallest, b.extremes.smallest),
          std::max(a.extremes.largest, b.extremes.largest)};
}

LogSum LogCurve::sum(const std::array<double, 4>& weights, const LogSums& sums) const {
  std::vector<std::pair<double, const LogMap*>> terms;
  for (size_t k = 0; k < 4; ++k)
    if (keys[k] && weights[k] != 0) terms.push_back({weights[k], &keys[k]->map});
  return sums.of(std::move(terms));
}

LogSum LogCurve::at(double u, const LogSums& sums) const {
  const double v = 1 - u;
  const std::array<double, 4> bernstein =
      smooth ? std::array<double, 4>{v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u}
             : std::array<double, 4>{v, 0, 0, u};
  std::array<double, 4> weights{};
  for (size_t p = 0; p < 4; ++p)
    for (size_t k = 0; k < 4; ++k) weights[k] += bernstein[p] * controls[p][k];
  return sum(weights, sums);
}

double LogCurve::share(double u) const {
  return smooth ? smoothstep(u) : u;
}

LogInterval::LogInterval(const LogSums& sums, const MeshLocator& locator, LogCurve curve,
                         const StillStations& still)
    : sums_(&sums),
      curve_(curve),
      limits_(extremes_of(curve.from(), curve.to())),
      conformal_(curve.from().map.w.isZero(0) && curve.to().map.w.isZero(0)),
      constant_(constant_combinations(std::span(still.numbers).first(still.kept), sums.count(),
                                      sums.holes())),
      still_(still.numbers),
      held_count_(static_cast<Index>(std::max<size_t>(1, still.kept))) {
  const Mesh& mesh = sums.mesh();
  std::vector<Line> lines;
  const auto place = [&](Complex z) {
    const int vertex = locator.vertex_near(z);
    anchors_.push_back(vertex);
    lines.push_back({mesh.vertices[static_cast<size_t>(vertex)], z});
  };
  for (const Complex z : still.positions) place(z);
  if (still_.empty())
    place(least_moving_point(mesh, curve.from().f, curve.to().f).in(mesh, mesh.vertices));
  lines_ = LineIntegrals(sums.basis(), lines);
  from_ = measured(curve.from());
  to_ = measured(curve.to());
}

LogInterval::End LogInterval::measured(const LogKey& key) const {
  const LogSum sum = sums_->of({{1, &key.map}});
  const VectorXc integrals = sums_->integrals(sum);
  return {constant_ * integrals, images(sum, key.f),
          key.f - sums_->without_jumps(sums_->on_mesh(sum).f, integrals.tail(sums_->holes()))};
}

/// Gives the sum a change. Returns whether the keys' extremes are proved for the result.
bool LogInterval::certifies(LogSum& sum, LogMap change) const {
  sum.change = std::move(change);
  return sum.change.l.allFinite() && sum.change.w.allFinite() &&
         sums_->certify(sum, limits_, kGrowth);
}

/// The same for a change that also has to reach its targets.
bool LogInterval::certifies(LogSum& sum, LogMap change, const Constraints& kept) const {
  if (!certifies(sum, std::move(change))) return false;
  const VectorXc off = sums_->misses(kept, sum);
  return off.size() == 0 || off.cwiseAbs().maxCoeff() <= 0.1 * kStillPin * sums_->size();
}

/// Starts at several changes between the least one and a change of l alone, which does not increase
/// |nu|. If limits are exceeded between samples, tries limits that are 2 % tighter.
bool LogInterval::keeps_within_limits(const Constraints& kept, LogSum& sum,
                                      const LogMap& least) const {
  if (kept.combinations.rows() == 0) return false;
  const LogSum blended = sum;
  const auto starting_at = [&](const LogMap& change) {
    LogSum start = blended;
    start.change = change;
    return start;
  };
  const LogMap alone = conformal_ ? least : sums_->change(kept, blended, true);
  const auto halfway = [&] { return starting_at(between(least, alone, 0.5)); };
  if (!blended.is_nu())
    return certifies(sum, alone, kept) ||
           (!conformal_ && certifies(sum, sums_->change(kept, halfway(), false), kept));
  for (const double part : {0.0, 0.5, 1.0}) {
    if (conformal_ && part > 0) break;
    for (const double margin : {0.0, 0.02}) {
      const Extremes within{(1 - margin) * limits_.shear, (1 + margin) * limits_.smallest};
      if (certifies(sum,
                    sums_->bounded_change(kept, starting_at(between(least, alone, part)), within,
                                          conformal_),
                    kept))
        return true;
    }
  }
  return false;
}

/// Changes the sum so that stations are where they should be and holes are closed; `least` is the
/// smallest change that does it. Returns whether that was possible within the keys' extremes.
bool LogInterval::keeps(const Constraints& kept, LogSum& sum, const LogMap& least) const {
  const LogSum blended = sum;
  if (certifies(sum, least, kept)) return true;
  sum = blended;
  return keeps_within_limits(kept, sum, least);
}

/// Gives the sum the largest part found of the way from the change `least`, which closes holes, to
/// `whole`, which also keeps stations, so that pins do not jump when they start to slide. Holes
/// stay closed.
bool LogInterval::keeps_partly(const Constraints& closed, LogSum& sum, const LogMap& least,
                               const LogMap& whole) const {
  const LogSum blended = sum;
  const auto certifies_part = [&](double part) {
    LogSum tried = blended;
    tried.change = between(least, whole, part);
    if (!certifies(tried, sums_->change(closed, tried, conformal_))) return false;
    sum = std::move(tried);
    return true;
  };
  constexpr double kLeast = 1e-3;
  double part = 0.5;
  while (part > kLeast && !certifies_part(part)) part *= 0.5;
  if (part <= kLeast) return certifies_part(0);
  constexpr int kBisections = 4;
  double step = 0.5 * part;
  for (int i = 0; i < kBisections; ++i, step *= 0.5)
    if (certifies_part(part + step)) part += step;
  return true;
}

/// Gives the sum the smallest change that certifies, of those that keep stations still and close
/// holes; or else smaller changes, toward the blend, which certifies. Holes stay closed. Returns
/// whether a change was proved.
bool LogInterval::correct(const VectorXc& wanted, LogSum& sum) const {
  const LogSum blended = sum;
  const Constraints kept{constant_, wanted};
  const LogMap whole = sums_->change(kept, blended, conformal_);
  if (keeps(kept, sum, whole)) return true;
  const Index holes = sums_->holes();
  const Constraints closed{constant_.bottomRows(holes), wanted.tail(holes)};
  const LogMap least = sums_->change(closed, blended, conformal_);
  sum = blended;
  if (keeps_partly(closed, sum, least, whole)) return true;
  sum = blended;
  if (keeps_within_limits(closed, sum, least)) return true;
  sum = blended;
  if (least.l.allFinite() && least.w.allFinite()) sum.change = least;
  return false;
}

/// Fills in f and its derivatives, and closes what integration leaves open around holes.
void LogInterval::draw(const LogSum& sum, double share, Blend& blend) const {
  MapOnMesh::Values values = sums_->on_mesh(sum);
  blend.first = std::move(values.first);
  blend.f = std::move(values.f);
  if (sums_->holes() > 0) {
    const VectorXc gaps = sums_->integrals(sum).tail(sums_->holes());
    blend.gap = gaps.cwiseAbs().maxCoeff();
    constexpr double kClosed = 1e-6;
    if (blend.gap > kClosed * sums_->size()) blend.certified = false;
    blend.f = sums_->without_jumps(std::move(blend.f), gaps);
  }
  blend.f += between(from_.off, to_.off, share);
  blend.f.array() += misses(sum, share, blend.f).head(held_count_).mean();
}

/// The images of the placed points by a sum with values f at the mesh's vertices.
VectorXc LogInterval::images(const LogSum& sum, const VectorXc& f) const {
  VectorXc images = lines_.of([&](const MatrixXc& c) { return sum.at(c); });
  for (size_t i = 0; i < anchors_.size(); ++i) images[static_cast<Index>(i)] += f[anchors_[i]];
  return images;
}

/// What the placed points miss their straight paths by.
VectorXc LogInterval::misses(const LogSum& sum, double share, const VectorXc& f) const {
  return between(from_.places, to_.places, share) - images(sum, f);
}

LogInterval::Blend LogInterval::at(double u, bool measures) const {
  const double share = curve_.share(u);
  LogSum sum = curve_.at(u, *sums_);
  Blend blend;
  VectorXc wanted = between(from_.constant, to_.constant, share);
  blend.certified = correct(wanted, sum);
  draw(sum, share, blend);
  // Integration along the mesh is less accurate, and a pass that gets only partway still helps the
  // next one.
  constexpr int kPasses = 3;
  constexpr double kClose = 0.1 * kStillPin;
  VectorXc off = misses(sum, share, blend.f);
  for (int pass = 0; pass < kPasses && blend.certified && held_count_ > 1; ++pass) {
    if (off.head(held_count_).cwiseAbs().maxCoeff() <= kClose * sums_->size()) break;
    wanted.head(held_count_ - 1) += off.segment(1, held_count_ - 1) - off.head(held_count_ - 1);
    const Constraints kept{constant_, wanted};
    LogSum closer = sum;
    if (!keeps(kept, closer, sums_->change(kept, sum, conformal_))) break;
    Blend better = blend;
    draw(closer, share, better);
    if (!better.certified) break;
    blend = std::move(better);
    sum = std::move(closer);
    off = misses(sum, share, blend.f);
  }
  for (size_t i = 0; i < still_.size(); ++i)
    if (const double distance = std::abs(off[static_cast<Index>(i)]);
        distance > kStillPin * sums_->size())
      blend.slides.push_back({still_[i], distance});
  if (measures && blend.certified && sum.is_nu())
    blend.extremes = sums_->certifier().extremes(sum.single());
  blend.map = std::move(sum);
  return blend;
}

}  // namespace holomorph
