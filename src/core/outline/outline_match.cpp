// The matrix of the fit is factored once. Then the targets and the map are updated alternately.
#include "core/outline/outline_match.h"

#include <algorithm>
#include <optional>

#include "core/cauchy/cauchy.h"
#include "core/geometry/deepest_point.h"
#include "core/geometry/orientation.h"
#include "core/outline/arc_length_start.h"
#include "core/outline/inner_loop.h"
#include "core/outline/outline_basis.h"
#include "core/outline/outline_samples.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerUnknown = 4;
constexpr size_t kPinTerm = 1;
constexpr double kInset = 7e-4;      ///< inset of the loop around the counted zeros, in diagonals
constexpr double kSoftInset = 5e-3;  ///< the same with stiffness, which is less accurate at corners
constexpr double kRoughlySettled = 1e-2;
constexpr int kMostRough = 4;
/// A new basis is built if the start differs from the one for which the basis was built by more
/// than this fraction of the target's length.
constexpr double kFar = 0.02;

/// The shape's own frame: its first vertex is at 0, its first chord is along the real axis, and its
/// perimeter is 1. Results computed in this frame do not depend on the drawing's position.
Similarity frame_of(const Cage& cage) {
  const Complex direction = cage.vertex(1) - cage.vertex(0);
  return {1.0 / (direction / std::abs(direction) * perimeter(flattened(cage).points)),
          cage.vertex(0), 0};
}

Points in(const Similarity& frame, Points points) {
  for (Complex& z : points) z = frame(z);
  return points;
}

Cage in(const Similarity& frame, Cage cage) {
  for (Points& segment : cage.segments) segment = in(frame, std::move(segment));
  return cage;
}

/// Rows of C phi + conj(C) psi.
MatrixXc with_conjugate(const MatrixXc& c, bool soft) {
  if (!soft) return c;
  MatrixXc both(c.rows(), 2 * c.cols());
  both << c, c.conjugate();
  return both;
}

/// The outline in counter-clockwise order. Throws the same Errors as check_outline.
Points checked(Points points) {
  check_outline(points);
  if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
  return points;
}

/// The largest difference between two correspondences of the same outlines, as a fraction of the
/// target's length.
double difference(const Correspondence& a, const Correspondence& b) {
  double most = 0;
  for (const double s : a.lengths.x) {
    const double off = (a(s) - b(s)) / a.target_length();
    most = std::max(most, std::abs(off - std::round(off)));
  }
  return most;
}

}  // namespace

OutlineFit::OutlineFit(const Cage& source, const Points& outline, const Points& pins,
                       const OutlineSettings& settings)
    : settings_(settings),
      given_(oriented(source)),
      frame_(frame_of(given_)),
      cage_(in(frame_, given_)),
      flat_(flattened(cage_)),
      source_(flat_.points, true),
      target_(in(frame_, checked(outline)), true),
      pins_(in(frame_, pins)),
      loop_(inner_loop(flat_.points,
                       (settings.stiffness > 0 ? kSoftInset : kInset) * source_.diagonal())),
      unit_(source_.length() / (2 * kPi)),
      center_(box_of(target_.points()).center()) {
  if (!settings_.published)
    start_ = std::make_unique<ConformalStart>(source_, target_, settings_.upright, pins_);
  if (start_ && start_->is_crowded()) start_.reset();
  build(start_                ? start_->best()
        : settings_.published ? by_arc_length(source_, target_)
                              : by_turning(source_, target_));
}

void OutlineFit::build(const Correspondence& start) {
  built_ = start;
  ++builds_;
  refined_ = false;
  set_up_basis(start);
  set_up_samples();
  fit_.emplace(terms());
}

void OutlineFit::solve(const Points& pinned) {
  pinned_ = in(frame_, pinned);
  solve_from(std::nullopt);
  // Keeping the picture upright must not make it fold. Pins decide themselves how it is rotated.
  if (!start_ || settings_.upright == 0 || !pins_.empty()) return;
  const int zeros = misses().zeros;
  if (zeros == 0) return;
  solve_from(0);
  start_->use_upright(settings_.upright);
  if (misses().zeros >= zeros) solve_from(settings_.upright);
}

/// Solves from the best start with this weight of the picture's rotation. Without pins, none keeps
/// the start of the last solution.
void OutlineFit::solve_from(std::optional<double> upright) {
  const Points wanted = held(pinned_);
  before_ = {};
  if (start_) start_->use_sharp(false);
  if (start_ && upright) start_->use_upright(*upright);
  if (start_ && (upright || !pins_.empty()))
    build(start_->best(pins_.empty() ? Points{} : wanted));
  else if (refined_)
    build(built_);
  fit_->reset();
  begin(built_, wanted);
  run(settings_.published ? AlternatingFit::Mode::zeroth : AlternatingFit::Mode::first_order,
      kSettled, settings_.most_iterations);
  if (may_refine() && !is_matched()) refine();
}

OutlineFit::Checkpoint OutlineFit::checkpoint() const {
  return {built_, refined_, start_ && start_->is_sharp(),
          start_ ? start_->pairs() : ConformalStart::Pairs{},
          now_.iterates.empty() ? VectorXc() : now_.iterates.back()};
}

void OutlineFit::follow(const Points& pinned, const Checkpoint& from) {
  if (from.unknowns.size() == 0 || (from.refined && pins_.empty())) return solve(pinned);
  before_ = {};
  pinned_ = in(frame_, pinned);
  const Points wanted = held(pinned_);
  if (start_ && !pins_.empty()) {
    start_->use_sharp(from.sharp);
    const Correspondence start = start_->follow(wanted, from.pairs);
    if (from.refined) return follow_start(start);
    if (difference(start, from.built) > kFar)
      build(start);
    else if (refined_ || difference(built_, from.built) > 0)
      build(from.built);
    begin(start, wanted);
    run(AlternatingFit::Mode::first_order, kRoughlySettled, kMostRough);
    // A single pin selects a conformal map. If there are several pins, there may be no conformal
    // map that meets them all.
    if (pins_.size() == 1 && may_refine() && !is_matched()) follow_start(start);
    return;
  }
  if (!pins_.empty()) fit_->set_targets(kPinTerm, pin_targets(wanted));
  fit_->reset(from.unknowns);
  fit_->resume();
  run(AlternatingFit::Mode::first_order, kRoughlySettled, kMostRough);
}

void OutlineFit::begin(const Correspondence& start, const Points& wanted) {
  if (!pins_.empty()) fit_->set_targets(kPinTerm, pin_targets(wanted));
  std::ranges::fill(hints_, 0);
  fit_->start(start_targets(start));
}

void OutlineFit::run(AlternatingFit::Mode mode, double settled, int most) {
  now_.iterates.clear();
  now_.energies.clear();
  fit_->run(mode, settled, most, [this] {
    now_.iterates.push_back(fit_->unknowns());
    now_.energies.push_back(fit_->energy() / (unit_ * unit_));
  });
}

OutlineMatch OutlineFit::after(int iteration) const {
  OutlineMatch match;
  const size_t number = static_cast<size_t>(iteration), earlier = before_.iterates.size();
  const Stage& stage = number < earlier ? before_ : now_;
  const Cage& basis = stage.basis;
  const VectorXc& x = stage.iterates.at(number < earlier ? number : number - earlier);
  match.basis = stage.given_basis;
  match.iterations = iteration;
  match.energies = before_.energies;
  match.energies.insert(match.energies.end(), now_.energies.begin(), now_.energies.end());
  const Index n = basis.control_count();
  const VectorXc phi = x.head(n).array() + center_, psi = x.tail(x.size() - n);
  const auto sum_of = [&](const MatrixXc& c) -> VectorXc {
    if (psi.size() == 0) return c * phi;
    return c * phi + c.conjugate() * psi;
  };
  const Complex axis = 1.0 / frame_.factor;
  const double size = std::abs(axis);
  match.phi = axis * phi.array() + frame_.from;
  match.psi = axis * psi;
  const Points wanted = held(pinned_);
  const VectorXc pins = sum_of(cauchy_coordinates(basis, pins_));
  for (size_t i = 0; i < wanted.size(); ++i) {
    match.pins_held += wanted[i] != pinned_[i];
    match.pins_missed =
        std::max(match.pins_missed, size * std::abs(pins[static_cast<Index>(i)] - wanted[i]));
  }
  const VectorXc values = sum_of(stage.at_samples);
  double sum = 0;
  for (const Complex& z : values) sum += std::norm(z - target_.nearest(z).point);
  match.rms = size * std::sqrt(sum / static_cast<double>(values.size()));
  const Polyline image(Points(values.begin(), values.end()), true);
  match.hausdorff =
      size * std::max(one_sided_distance(image, target_), one_sided_distance(target_, image));
  const auto slopes = [&](const Points& places) {
    return product(planar_coordinates<double>(basis, places, 1), phi);
  };
  match.zeros = zeros_inside(loop_, product(stage.slopes_inside, phi), slopes);
  return match;
}

// Vertices are spaced uniformly in a weighted sum of relative arc lengths: 0.3 times the source's
// plus 0.7 times the target's. The cage's own vertices are kept, and each of its segments is cut
// separately. For each corner of the target, the nearest vertex is moved to the corner's preimage,
// because f' behaves like a power there. If cuts ignored the cage's vertices, they would leave
// slivers next to them, and f' would have zeros for most pairs of outlines.
void OutlineFit::set_up_basis(const Correspondence& start) {
  const double own = settings_.published ? 1 : 0.3;
  const auto vertex_parameter = [&](double s) {
    return own * s / start.source_length() +
           (1 - own) * (start(s) - start(0)) / start.target_length();
  };
  std::vector<double> ends, cuts;
  for (size_t i = 0; i < flat_.locations.size(); ++i)
    if (flat_.locations[i].t == 0) ends.push_back(source_.length_at(static_cast<Index>(i), 0));
  ends.push_back(source_.length());
  for (size_t e = 0; e + 1 < ends.size(); ++e) {
    const double from = vertex_parameter(ends[e]), to = vertex_parameter(ends[e + 1]);
    const int parts =
        std::max(1, static_cast<int>(std::lround((to - from) * settings_.vertices /
                                                 cage_.degree(static_cast<Index>(e)))));
    for (int k = 1; k < parts; ++k) {
      const double wanted = from + (to - from) * k / parts;
      double low = ends[e], high = ends[e + 1];
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (vertex_parameter(middle) < wanted ? low : high) = middle;
      }
      cuts.push_back(0.5 * (low + high));
    }
  }
  const Correspondence back = start.inverse();
  const double length = start.source_length();
  for (const double corner : corners_of(target_)) {
    const double at = back(corner), once = at - std::floor(at / length) * length;
    const auto nearest =
        std::ranges::min_element(cuts, {}, [&](double cut) { return std::abs(cut - once); });
    if (nearest != cuts.end()) *nearest = once;
  }
  const Cuts places = cuts_at(cage_, flat_, source_, std::move(cuts));
  constexpr double kLeast = 1e-3;  // fraction of a segment; shorter pieces are not cut off
  now_.basis = cut(cage_, places, kLeast);
  now_.given_basis = cut(given_, places, kLeast);
}

void OutlineFit::set_up_samples() {
  samples_.clear();
  middles_.clear();
  sizes_.clear();
  for (Index e = 0; e < now_.basis.size(); ++e) {
    const Complex direction = now_.basis.end_vertex(e) - now_.basis.vertex(e);
    // A curve has as many unknowns as its degree, and a proportional number of samples.
    const int degree = now_.basis.degree(e), count = kSamplesPerUnknown * degree;
    for (int k = 0; k < count; ++k) samples_.push_back({e, static_cast<double>(k) / count});
    for (int k = 0; k < degree; ++k) {
      middles_.push_back({e, (k + 0.5) / degree});
      sizes_.push_back(std::abs(direction) / degree);
    }
  }
  hints_.assign(samples_.size(), 0);
  now_.at_samples = coordinates_at(now_.basis, samples_, 0);
  now_.slopes_inside = planar_coordinates<double>(now_.basis, loop_, 1);
}

std::vector<FitTerm> OutlineFit::terms() {
  const bool soft = settings_.stiffness > 0;
  const Index n = now_.basis.control_count();
  std::vector<FitTerm> terms;
  FitTerm fit{with_conjugate(now_.at_samples, soft)};
  fit.project = [this](const VectorXc& values, VectorXc& targets) { project(values, targets); };
  fit.normals = [this](const VectorXc& values, const VectorXc& targets, VectorXc& normals) {
    set_up_normals(values, targets, normals);
  };
  terms.push_back(std::move(fit));
  if (!pins_.empty())
    terms.push_back(
        {with_conjugate(cauchy_coordinates(now_.basis, pins_), soft), settings_.pin_weight});
  if (settings_.smoothness > 0 && !settings_.published) {
    MatrixXc rows = with_conjugate(coordinates_at(now_.basis, middles_, 2), soft);
    for (Index e = 0; e < rows.rows(); ++e)
      rows.row(e) *= sizes_[static_cast<size_t>(e)] * sizes_[static_cast<size_t>(e)];
    terms.push_back({std::move(rows), settings_.smoothness});
  }
  if (soft) {
    MatrixXc rows = MatrixXc::Zero(static_cast<Index>(middles_.size()), 2 * n);
    rows.rightCols(n) = unit_ * coordinates_at(now_.basis, middles_, 1).conjugate();
    terms.push_back({std::move(rows), settings_.stiffness});
    MatrixXc constant = MatrixXc::Zero(1, 2 * n);  // fixes the constant that phi and psi share
    constant.rightCols(n).setConstant(1 / static_cast<double>(n));
    terms.push_back({std::move(constant)});
  }
  return terms;
}

void OutlineFit::project(const VectorXc& values, VectorXc& targets) {
  for (Index i = 0; i < values.size(); ++i) {
    Index& hint = hints_[static_cast<size_t>(i)];
    const Polyline::Nearest nearest = target_.nearest(values[i] + center_, hint);
    hint = nearest.segment;
    targets[i] = nearest.point - center_;
  }
}

void OutlineFit::set_up_normals(const VectorXc& values, const VectorXc& targets,
                                VectorXc& normals) const {
  const double near = 1e-9 * target_.diagonal();
  for (Index i = 0; i < values.size(); ++i) {
    Complex across = values[i] - targets[i];
    if (std::abs(across) <= near) {
      const size_t s = static_cast<size_t>(hints_[static_cast<size_t>(i)]);
      across = kI * (target_.points()[(s + 1) % target_.points().size()] - target_.points()[s]);
    }
    normals[i] = across / std::abs(across);
  }
}

Points OutlineFit::held(const Points& pinned) const {
  constexpr int kDirections = 16, kMostHalvings = 40;
  if (settings_.published) return pinned;
  Points inside = pinned;
  for (Complex& z : inside) {
    if (winding_number(target_.points(), z) != 0) continue;
    const Complex nearest = target_.nearest(z).point;
    // Take the deepest point of a small ring around the nearest point. If no point of the ring is
    // inside, try smaller rings. The directions rotate from ring to ring to find even a needle that
    // is narrower than the gaps between directions.
    double depth = 0, step = 0.05 * target_.diagonal();
    for (int ring = 0; ring < kMostHalvings && depth == 0; ++ring, step /= 2)
      for (int k = 0; k < kDirections; ++k) {
        const double direction = k + 0.38 * ring;
        const Complex candidate = nearest + std::polar(step, 2 * kPi * direction / kDirections);
        if (winding_number(target_.points(), candidate) == 0) continue;
        if (const double here = target_.nearest(candidate).distance; here > depth)
          depth = here, z = candidate;
      }
    if (depth == 0) z = deepest_point(target_);
  }
  return inside;
}

VectorXc OutlineFit::pin_targets(const Points& pinned) const {
  VectorXc targets(static_cast<Index>(pinned.size()));
  for (Index i = 0; i < targets.size(); ++i) targets[i] = pinned[static_cast<size_t>(i)] - center_;
  return targets;
}

VectorXc OutlineFit::start_targets(const Correspondence& start) const {
  VectorXc targets(static_cast<Index>(samples_.size()));
  for (Index i = 0; i < targets.size(); ++i) {
    const Polyline::Nearest at =
        source_.nearest(position_of(now_.basis, samples_[static_cast<size_t>(i)]));
    targets[i] = target_.at(start(source_.length_at(at.segment, at.parameter))) - center_;
  }
  return targets;
}

void check_outline(std::span<const Complex> outline) {
  if (outline.size() < 3)
    throw Error(ErrorKind::bad_input, "the outline needs at least three points");
  for (const Complex& z : outline)
    if (!std::isfinite(z.real()) || !std::isfinite(z.imag()))
      throw Error(ErrorKind::bad_input, "the outline has a point that is not finite");
  for (size_t i = 0; i < outline.size(); ++i)
    if (outline[i] == outline[(i + 1) % outline.size()])
      throw Error(ErrorKind::bad_input,
                  "the outline repeats a point; delete one of the two at " + point_text(outline[i]),
                  outline[i]);
  if (const auto crossing = self_crossing(outline)) {
    const Complex where = crossing->point;
    throw Error(ErrorKind::bad_input, "the outline crosses itself near " + point_text(where),
                where);
  }
  if (signed_area(outline) == 0) throw Error(ErrorKind::bad_input, "the outline encloses no area");
}

OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings) {
  check(task.pins.size() == task.pinned.size(), "outline: one target for each pin");
  OutlineFit fit(task.source, task.outline, task.pins, settings);
  fit.solve(task.pinned);
  return fit.after(fit.iterations());
}

}  // namespace holomorph
