// Rows once, then targets and map in turn.
#include "core/outline_match.h"

#include <algorithm>
#include <memory>

#include "core/alternating_fit.h"
#include "core/argument.h"
#include "core/cauchy.h"
#include "core/cauchy_array.h"
#include "core/outline_start.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerSegment = 4;
constexpr size_t kPinTerm = 1;
constexpr double kSettled = 1e-3;  ///< relative decrease of the energy that ends the iteration

/// The loop cut at arc lengths of its flattened self, all its own vertices kept.
Cage cut_at(const Cage& cage, const FlatCage& flat, const Polyline& line,
            std::vector<double> lengths) {
  std::vector<std::vector<double>> cuts(static_cast<size_t>(cage.size()));
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
  Cage fine;
  for (Index e = 0; e < cage.size(); ++e) {
    Points rest = cage.controls(e);
    double before = 0;
    std::vector<double>& places = cuts[static_cast<size_t>(e)];
    std::ranges::sort(places);
    // Pieces of less than a thousandth are none.
    constexpr double kLeast = 1e-3;
    for (const double t : places) {
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

class Matcher {
 public:
  Matcher(const OutlineTask& task, const OutlineSettings& settings)
      : settings_(settings),
        cage_(counter_clockwise(task.source)),
        flat_(flattened(cage_)),
        source_(flat_.points, true),
        target_(run_counter_clockwise(task.outline), true),
        pins_(task.pins),
        pinned_(task.pinned),
        unit_(source_.length() / (2 * kPi)),
        centre_(box_of(target_.points()).center()) {}

  OutlineMatch run() {
    OutlineMatch best;
    const Correspondence start =
        settings_.published ? by_arc_length()
                            : conformal_correspondence(source_, target_, settings_.upright);
    best.log_stretch = start.log_stretch;
    best.basis = basis(start);
    prepare(best.basis);
    const bool soft = settings_.stiffness > 0;
    AlternatingFit fit(terms(best.basis));
    if (!pins_.empty()) fit.give(kPinTerm, pin_targets());
    fit.start(start_targets(best.basis, start));
    best.energies = fit.run(
        settings_.published ? AlternatingFit::Mode::zeroth : AlternatingFit::Mode::first_order,
        kSettled, settings_.most_iterations);
    best.iterations = static_cast<int>(best.energies.size()) - 1;
    for (double& energy : best.energies) energy /= unit_ * unit_;
    const VectorXc x = fit.unknowns();
    const Index n = best.basis.control_count();
    best.phi = x.head(n).array() + centre_;
    if (soft) best.psi = x.tail(n);
    best.rms = fit.distance(0);
    measure(fit.values(0), best);
    best.zeros = zeros_of(best);
    return best;
  }

 private:
  static Points run_counter_clockwise(Points points) {
    if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
    return points;
  }

  /// Equal shares of both lengths, from the pair of starts that moves the least.
  Correspondence by_arc_length() const {
    constexpr Index kPoints = 200;
    const Points from = at_equal_lengths(source_, kPoints), to = at_equal_lengths(target_, kPoints);
    const Complex centre_from = mean(from), centre_to = mean(to);
    Index best = 0;
    double least = -1;
    for (Index shift = 0; shift < kPoints; ++shift) {
      double sum = 0;
      for (Index i = 0; i < kPoints; ++i)
        sum += std::norm(from[static_cast<size_t>(i)] - centre_from -
                         to[static_cast<size_t>((i + shift) % kPoints)] + centre_to);
      if (least < 0 || sum < least) least = sum, best = shift;
    }
    Correspondence result;
    result.source_length = source_.length();
    result.target_length = target_.length();
    result.source = {0, 0.5 * source_.length()};
    const double offset = target_.length() * static_cast<double>(best) / kPoints;
    result.target = {offset, offset + 0.5 * target_.length()};
    return result;
  }
  static Complex mean(const Points& points) {
    Complex sum = 0;
    for (const Complex& z : points) sum += z;
    return sum / static_cast<double>(points.size());
  }

  /// Vertices uniform in 0.3 of the source's length and 0.7 of the target's; but for the cage's
  /// own, which stay, so that each of its segments is cut into parts of its own.
  Cage basis(const Correspondence& start) const {
    const double own = settings_.published ? 1 : 0.3;
    const auto share = [&](double s) {
      return own * s / start.source_length +
             (1 - own) * (start(s) - start(0)) / start.target_length;
    };
    std::vector<double> ends, cuts;
    for (size_t i = 0; i < flat_.places.size(); ++i)
      if (flat_.places[i].t == 0) ends.push_back(source_.length_at(static_cast<Index>(i), 0));
    ends.push_back(source_.length());
    for (size_t e = 0; e + 1 < ends.size(); ++e) {
      const double from = share(ends[e]), to = share(ends[e + 1]);
      const int parts =
          std::max(1, static_cast<int>(std::lround((to - from) * settings_.vertices)));
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
    return cut_at(cage_, flat_, source_, std::move(cuts));
  }

  void prepare(const Cage& basis) {
    for (Index e = 0; e < basis.size(); ++e) {
      for (int k = 0; k < kSamplesPerSegment; ++k)
        samples_.push_back({e, static_cast<double>(k) / kSamplesPerSegment});
      middles_.push_back({e, 0.5});
      sizes_.push_back(std::abs(basis.vertex(e + 1) - basis.vertex(e)));
    }
    hints_.assign(samples_.size(), 0);
  }

  std::vector<FitTerm> terms(const Cage& basis) {
    const bool soft = settings_.stiffness > 0;
    const Index n = basis.control_count();
    std::vector<FitTerm> terms;
    FitTerm fit{with_conjugate(coordinates(basis, samples_, 0), soft)};
    fit.project = [this](const VectorXc& values, VectorXc& targets) { project(values, targets); };
    fit.normals = [this](const VectorXc& values, const VectorXc& targets, VectorXc& normals) {
      take_normals(values, targets, normals);
    };
    terms.push_back(std::move(fit));
    if (!pins_.empty())
      terms.push_back(
          {with_conjugate(cauchy_coordinates(basis, pins_), soft), settings_.pin_weight});
    if (settings_.smoothness > 0 && !settings_.published) {
      MatrixXc rows = with_conjugate(coordinates(basis, middles_, 2), soft);
      for (Index e = 0; e < rows.rows(); ++e)
        rows.row(e) *= sizes_[static_cast<size_t>(e)] * sizes_[static_cast<size_t>(e)];
      terms.push_back({std::move(rows), settings_.smoothness});
    }
    if (soft) {
      MatrixXc rows = MatrixXc::Zero(basis.size(), 2 * n);
      rows.rightCols(n) = unit_ * coordinates(basis, middles_, 1).conjugate();
      terms.push_back({std::move(rows), settings_.stiffness});
      MatrixXc constant = MatrixXc::Zero(1, 2 * n);  // phi and psi share their constants
      constant.rightCols(n).setConstant(1 / static_cast<double>(n));
      terms.push_back({std::move(constant)});
    }
    return terms;
  }

  void project(const VectorXc& values, VectorXc& targets) {
    for (Index i = 0; i < values.size(); ++i) {
      Index& hint = hints_[static_cast<size_t>(i)];
      const Polyline::Nearest nearest = target_.nearest(values[i] + centre_, hint);
      hint = nearest.segment;
      targets[i] = nearest.point - centre_;
    }
  }

  void take_normals(const VectorXc& values, const VectorXc& targets, VectorXc& normals) const {
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

  VectorXc pin_targets() const {
    VectorXc targets(static_cast<Index>(pinned_.size()));
    for (Index i = 0; i < targets.size(); ++i)
      targets[i] = pinned_[static_cast<size_t>(i)] - centre_;
    return targets;
  }

  VectorXc start_targets(const Cage& basis, const Correspondence& start) const {
    VectorXc targets(static_cast<Index>(samples_.size()));
    for (Index i = 0; i < targets.size(); ++i) {
      const Polyline::Nearest at =
          source_.nearest(position_of(basis, samples_[static_cast<size_t>(i)]));
      targets[i] = target_.at(start(source_.length_at(at.segment, at.parameter))) - centre_;
    }
    return targets;
  }

  void measure(const VectorXc& values, OutlineMatch& match) const {
    Points points;
    for (const Complex& z : values) points.push_back(z + centre_);
    const Polyline image(std::move(points), true);
    match.hausdorff =
        std::max(one_sided_distance(image, target_), one_sided_distance(target_, image));
  }

  /// At the vertices themselves f_z has logarithms.
  int zeros_of(const OutlineMatch& match) const {
    constexpr double kInset = 0.02;
    Points inset;
    for (Index e = 0; e < match.basis.size(); ++e) {
      const Complex way = match.basis.vertex(e + 1) - match.basis.vertex(e);
      for (int k = 0; k < kSamplesPerSegment; ++k)
        inset.push_back(position_of(match.basis, {e, (k + 0.5) / kSamplesPerSegment}) +
                        kInset * kI * way);
    }
    return turns_of(product(planar_coordinates<double>(match.basis, inset, 1), match.phi));
  }

  const OutlineSettings& settings_;
  Cage cage_;
  FlatCage flat_;
  Polyline source_, target_;
  Points pins_, pinned_;
  double unit_;     ///< L
  Complex centre_;  ///< what is fitted is f less this
  std::vector<BoundaryPoint> samples_, middles_;
  std::vector<double> sizes_;
  std::vector<Index> hints_;
};

}  // namespace

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
    const Complex where = outline[static_cast<size_t>(crossing->first)];
    throw Error(ErrorKind::bad_input, "the outline crosses itself near " + point_text(where),
                where);
  }
  if (signed_area(outline) == 0) throw Error(ErrorKind::bad_input, "the outline encloses nothing");
}

OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings) {
  check_outline(task.outline);
  check(task.pins.size() == task.pinned.size(), "outline: a place for each pin");
  return Matcher(task, settings).run();
}

}  // namespace holomorph
