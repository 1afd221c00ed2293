// Rows once, then targets and map in turn.
#include "core/outline_match.h"

#include <algorithm>
#include <optional>

#include "core/argument.h"
#include "core/cauchy.h"
#include "core/equal_shares.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerUnknown = 4;
constexpr size_t kPinTerm = 1;
constexpr double kInset = 0.02;  ///< of the loop that zeros are counted in, in edges
constexpr double kRoughlySettled = 1e-2;
constexpr int kMostRough = 4;
constexpr double kFar = 0.02;  ///< from the start that a basis was made for, in turns of the target
constexpr double kSettled = 1e-3;  ///< relative decrease of the energy that ends the iteration

/// Increasing parameters for each segment of a cage.
using Cuts = std::vector<std::vector<double>>;

/// Those at arc lengths of its flattened self.
Cuts cuts_at(const Cage& cage, const FlatCage& flat, const Polyline& line,
             std::vector<double> lengths) {
  Cuts cuts(static_cast<size_t>(cage.size()));
  std::ranges::sort(lengths);
  for (const double length : lengths) {
    const Polyline::Nearest at = line.nearest(line.at(length));
    const size_t i = static_cast<size_t>(at.segment), next = (i + 1) % flat.places.size();
    const Index segment = flat.places[i].segment;
    const double from = flat.places[i].t,
                 to = flat.places[next].segment == segment && flat.places[next].t > from
                          ? flat.places[next].t
                          : 1;
    cuts[static_cast<size_t>(segment)].push_back(from + at.parameter * (to - from));
  }
  for (std::vector<double>& places : cuts) std::ranges::sort(places);
  return cuts;
}

/// All the cage's own vertices are kept.
Cage cut(const Cage& cage, const Cuts& cuts) {
  // Pieces of less than a thousandth are none.
  constexpr double kLeast = 1e-3;
  Cage fine;
  for (Index e = 0; e < cage.size(); ++e) {
    Points rest = cage.controls(e);
    double before = 0;
    for (const double t : cuts[static_cast<size_t>(e)]) {
      if (t - before < kLeast || 1 - t < kLeast) continue;
      SplitCurve halves = split(rest, (t - before) / (1 - before));
      halves.before.pop_back();
      fine.segments.push_back(std::move(halves.before));
      rest = std::move(halves.after);
      before = t;
    }
    rest.pop_back();
    fine.segments.push_back(std::move(rest));
  }
  return fine;
}

/// A frame of the shape's own: its first vertex at 0, its first chord along the real axis, its
/// perimeter 1. What is computed there does not depend on where the drawing stands.
Similarity frame_of(const Cage& cage) {
  const Complex way = cage.vertex(1) - cage.vertex(0);
  return {1.0 / (way / std::abs(way) * perimeter(flattened(cage).points)), cage.vertex(0), 0};
}

Points in(const Similarity& frame, Points points) {
  for (Complex& z : points) z = frame(z);
  return points;
}

Cage in(const Similarity& frame, Cage cage) {
  for (Points& segment : cage.segments) segment = in(frame, std::move(segment));
  return cage;
}

MatrixXc coordinates(const Cage& cage, std::span<const BoundaryPoint> places, int order) {
  if (order > 1 || !is_straight(cage)) return cauchy_coordinates(cage, places, order);
  Points points;
  for (const BoundaryPoint& place : places) points.push_back(position_of(cage, place));
  return as_complex(planar_coordinates<double>(cage, points, order));
}

/// Rows of C phi + conj(C) psi.
MatrixXc with_conjugate(const MatrixXc& c, bool soft) {
  if (!soft) return c;
  MatrixXc both(c.rows(), 2 * c.cols());
  both << c, c.conjugate();
  return both;
}

/// Counter-clockwise. Throws Error as check_outline does.
Points checked(Points points) {
  check_outline(points);
  if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
  return points;
}

/// How far two correspondences of the same outlines lie apart, in turns of the target.
double difference(const Correspondence& a, const Correspondence& b) {
  double most = 0;
  for (const double s : a.source) {
    const double off = (a(s) - b(s)) / a.target_length;
    most = std::max(most, std::abs(off - std::round(off)));
  }
  return most;
}

/// The arc lengths of a closed polyline's vertices that are none of a smooth curve's.
std::vector<double> corners_of(const Polyline& curve) {
  constexpr double kCorner = kPi / 6;
  std::vector<double> corners;
  const Points& points = curve.points();
  for (Index i = 0; i < curve.segments(); ++i) {
    const size_t n = points.size(), k = static_cast<size_t>(i);
    const Complex in = points[k] - points[(k + n - 1) % n], out = points[(k + 1) % n] - points[k];
    if (std::abs(std::arg(out / in)) > kCorner) corners.push_back(curve.length_at(i, 0));
  }
  return corners;
}

}  // namespace

OutlineFit::OutlineFit(const Cage& source, const Points& outline, const Points& pins,
                       const OutlineSettings& settings)
    : settings_(settings),
      given_(counter_clockwise(source)),
      frame_(frame_of(given_)),
      cage_(in(frame_, given_)),
      flat_(flattened(cage_)),
      source_(flat_.points, true),
      target_(in(frame_, checked(outline)), true),
      pins_(in(frame_, pins)),
      unit_(source_.length() / (2 * kPi)),
      centre_(box_of(target_.points()).center()) {
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
  take_basis(start);
  take_samples();
  fit_.emplace(terms());
}

void OutlineFit::solve(const Points& pinned) {
  pinned_ = in(frame_, pinned);
  const Points wanted = held(pinned_);
  if (start_ && !pins_.empty()) build(start_->best(wanted));
  fit_->reset();
  begin(built_, wanted);
  run(settings_.published ? AlternatingFit::Mode::zeroth : AlternatingFit::Mode::first_order,
      kSettled, settings_.most_iterations);
}

void OutlineFit::follow(const Points& pinned) {
  if (iterates_.empty()) return solve(pinned);
  pinned_ = in(frame_, pinned);
  const Points wanted = held(pinned_);
  if (start_ && !pins_.empty()) {
    const Correspondence start = start_->follow(wanted);
    if (difference(start, built_) > kFar) build(start);
    begin(start, wanted);
  } else {
    if (!pins_.empty()) fit_->give(kPinTerm, pin_targets(wanted));
    fit_->resume();
  }
  run(AlternatingFit::Mode::first_order, kRoughlySettled, kMostRough);
}

void OutlineFit::begin(const Correspondence& start, const Points& wanted) {
  if (!pins_.empty()) fit_->give(kPinTerm, pin_targets(wanted));
  std::ranges::fill(hints_, 0);
  fit_->start(start_targets(start));
}

void OutlineFit::run(AlternatingFit::Mode mode, double settled, int most) {
  iterates_.clear();
  energies_.clear();
  fit_->run(mode, settled, most, [this] {
    iterates_.push_back(fit_->unknowns());
    energies_.push_back(fit_->energy() / (unit_ * unit_));
  });
}

OutlineMatch OutlineFit::after(int iteration) const {
  OutlineMatch match;
  match.basis = given_basis_;
  match.iterations = iteration;
  match.energies = energies_;
  const VectorXc& x = iterates_.at(static_cast<size_t>(iteration));
  const Index n = basis_.control_count();
  const VectorXc phi = x.head(n).array() + centre_, psi = x.tail(x.size() - n);
  const auto sum_of = [&](const MatrixXc& c) -> VectorXc {
    if (psi.size() == 0) return c * phi;
    return c * phi + c.conjugate() * psi;
  };
  const Complex axis = 1.0 / frame_.factor;
  const double size = std::abs(axis);
  match.phi = axis * phi.array() + frame_.from;
  match.psi = axis * psi;
  const Points wanted = held(pinned_);
  const VectorXc pins = sum_of(cauchy_coordinates(basis_, pins_));
  for (size_t i = 0; i < wanted.size(); ++i) {
    match.pins_held += wanted[i] != pinned_[i];
    match.pins_missed =
        std::max(match.pins_missed, size * std::abs(pins[static_cast<Index>(i)] - wanted[i]));
  }
  const VectorXc values = sum_of(at_samples_);
  double sum = 0;
  for (const Complex& z : values) sum += std::norm(z - target_.nearest(z).point);
  match.rms = size * std::sqrt(sum / static_cast<double>(values.size()));
  const Polyline image(Points(values.begin(), values.end()), true);
  match.hausdorff =
      size * std::max(one_sided_distance(image, target_), one_sided_distance(target_, image));
  match.zeros = turns_of(product(slopes_inside_, phi));
  return match;
}

// Vertices uniform in 0.3 of the source's length and 0.7 of the target's; but for the cage's
// own, which stay, so that each of its segments is cut into parts of its own, and for those that
// come to the target's corners: f' is a power there.
void OutlineFit::take_basis(const Correspondence& start) {
  const double own = settings_.published ? 1 : 0.3;
  const auto share = [&](double s) {
    return own * s / start.source_length + (1 - own) * (start(s) - start(0)) / start.target_length;
  };
  std::vector<double> ends, cuts;
  for (size_t i = 0; i < flat_.places.size(); ++i)
    if (flat_.places[i].t == 0) ends.push_back(source_.length_at(static_cast<Index>(i), 0));
  ends.push_back(source_.length());
  for (size_t e = 0; e + 1 < ends.size(); ++e) {
    const double from = share(ends[e]), to = share(ends[e + 1]);
    const int parts =
        std::max(1, static_cast<int>(std::lround((to - from) * settings_.vertices /
                                                 cage_.degree(static_cast<Index>(e)))));
    for (int k = 1; k < parts; ++k) {
      const double wanted = from + (to - from) * k / parts;
      double low = ends[e], high = ends[e + 1];
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (share(middle) < wanted ? low : high) = middle;
      }
      cuts.push_back(0.5 * (low + high));
    }
  }
  const Correspondence back = start.inverse();
  const double length = start.source_length;
  for (const double corner : corners_of(target_)) {
    const double at = back(corner), once = at - std::floor(at / length) * length;
    const auto nearest =
        std::ranges::min_element(cuts, {}, [&](double cut) { return std::abs(cut - once); });
    if (nearest != cuts.end()) *nearest = once;
  }
  const Cuts places = cuts_at(cage_, flat_, source_, std::move(cuts));
  basis_ = cut(cage_, places);
  given_basis_ = cut(given_, places);
}

void OutlineFit::take_samples() {
  samples_.clear();
  middles_.clear();
  sizes_.clear();
  Points inset;
  for (Index e = 0; e < basis_.size(); ++e) {
    const Complex way = basis_.vertex(e + 1) - basis_.vertex(e);
    // A curve has as many unknowns as its degree, so it gets as many times the places.
    const int degree = basis_.degree(e), count = kSamplesPerUnknown * degree;
    for (int k = 0; k < count; ++k) {
      samples_.push_back({e, static_cast<double>(k) / count});
      // At the vertices themselves f_z has logarithms.
      inset.push_back(position_of(basis_, {e, (k + 0.5) / count}) + kInset / degree * kI * way);
    }
    for (int k = 0; k < degree; ++k) {
      middles_.push_back({e, (k + 0.5) / degree});
      sizes_.push_back(std::abs(way) / degree);
    }
  }
  hints_.assign(samples_.size(), 0);
  at_samples_ = coordinates(basis_, samples_, 0);
  slopes_inside_ = planar_coordinates<double>(basis_, inset, 1);
}

std::vector<FitTerm> OutlineFit::terms() {
  const bool soft = settings_.stiffness > 0;
  const Index n = basis_.control_count();
  std::vector<FitTerm> terms;
  FitTerm fit{with_conjugate(at_samples_, soft)};
  fit.project = [this](const VectorXc& values, VectorXc& targets) { project(values, targets); };
  fit.normals = [this](const VectorXc& values, const VectorXc& targets, VectorXc& normals) {
    take_normals(values, targets, normals);
  };
  terms.push_back(std::move(fit));
  if (!pins_.empty())
    terms.push_back(
        {with_conjugate(cauchy_coordinates(basis_, pins_), soft), settings_.pin_weight});
  if (settings_.smoothness > 0 && !settings_.published) {
    MatrixXc rows = with_conjugate(coordinates(basis_, middles_, 2), soft);
    for (Index e = 0; e < rows.rows(); ++e)
      rows.row(e) *= sizes_[static_cast<size_t>(e)] * sizes_[static_cast<size_t>(e)];
    terms.push_back({std::move(rows), settings_.smoothness});
  }
  if (soft) {
    MatrixXc rows = MatrixXc::Zero(static_cast<Index>(middles_.size()), 2 * n);
    rows.rightCols(n) = unit_ * coordinates(basis_, middles_, 1).conjugate();
    terms.push_back({std::move(rows), settings_.stiffness});
    MatrixXc constant = MatrixXc::Zero(1, 2 * n);  // phi and psi share their constants
    constant.rightCols(n).setConstant(1 / static_cast<double>(n));
    terms.push_back({std::move(constant)});
  }
  return terms;
}

void OutlineFit::project(const VectorXc& values, VectorXc& targets) {
  for (Index i = 0; i < values.size(); ++i) {
    Index& hint = hints_[static_cast<size_t>(i)];
    const Polyline::Nearest nearest = target_.nearest(values[i] + centre_, hint);
    hint = nearest.segment;
    targets[i] = nearest.point - centre_;
  }
}

void OutlineFit::take_normals(const VectorXc& values, const VectorXc& targets,
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
  constexpr int kWays = 16, kMostHalvings = 40;
  if (settings_.published) return pinned;
  Points inside = pinned;
  for (Complex& z : inside) {
    if (winding_number(target_.points(), z) != 0) continue;
    const Complex nearest = target_.nearest(z).point;
    // A little inside, less where the outline is thin: of the places around, the deepest one. They
    // turn from ring to ring, so that a needle narrower than the ways between is found, too.
    double depth = 0, step = 0.05 * target_.diagonal();
    for (int ring = 0; ring < kMostHalvings && depth == 0; ++ring, step /= 2)
      for (int k = 0; k < kWays; ++k) {
        const double way = k + 0.38 * ring;
        const Complex place = nearest + std::polar(step, 2 * kPi * way / kWays);
        if (winding_number(target_.points(), place) == 0) continue;
        if (const double here = target_.nearest(place).distance; here > depth)
          depth = here, z = place;
      }
    if (depth == 0) z = deepest_point(target_);
  }
  return inside;
}

VectorXc OutlineFit::pin_targets(const Points& pinned) const {
  VectorXc targets(static_cast<Index>(pinned.size()));
  for (Index i = 0; i < targets.size(); ++i) targets[i] = pinned[static_cast<size_t>(i)] - centre_;
  return targets;
}

VectorXc OutlineFit::start_targets(const Correspondence& start) const {
  VectorXc targets(static_cast<Index>(samples_.size()));
  for (Index i = 0; i < targets.size(); ++i) {
    const Polyline::Nearest at =
        source_.nearest(position_of(basis_, samples_[static_cast<size_t>(i)]));
    targets[i] = target_.at(start(source_.length_at(at.segment, at.parameter))) - centre_;
  }
  return targets;
}

void check_outline(std::span<const Complex> outline) {
  if (outline.size() < 3)
    throw Error(ErrorKind::bad_input, "the outline needs three points at least");
  for (const Complex& z : outline)
    if (!std::isfinite(z.real()) || !std::isfinite(z.imag()))
      throw Error(ErrorKind::bad_input, "the outline has a point that is not finite");
  for (size_t i = 0; i < outline.size(); ++i)
    if (outline[i] == outline[(i + 1) % outline.size()])
      throw Error(ErrorKind::bad_input,
                  "the outline has the same point twice at " + point_text(outline[i]), outline[i]);
  if (const auto crossing = self_crossing(outline)) {
    const Complex where = crossing->point;
    throw Error(ErrorKind::bad_input, "the outline crosses itself near " + point_text(where),
                where);
  }
  if (signed_area(outline) == 0) throw Error(ErrorKind::bad_input, "the outline encloses nothing");
}

OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings) {
  check(task.pins.size() == task.pinned.size(), "outline: a place for each pin");
  OutlineFit fit(task.source, task.outline, task.pins, settings);
  fit.solve(task.pinned);
  return fit.after(fit.iterations());
}

}  // namespace holomorph
