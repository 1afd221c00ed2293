// If the usual fit misses the outline or folds, it is replaced by a weighted least-squares fit to
// the conformal map itself. The vertices are graded according to that map.
#include <algorithm>

#include "core/outline/graded_cuts.h"
#include "core/outline/outline_basis.h"
#include "core/outline/outline_match.h"
#include "core/outline/outline_samples.h"
#include "core/solvers/dense.h"

namespace holomorph {
namespace {

constexpr double kAccepted = 0.8 * kOutlineMatched;  ///< leaves a margin for sampling
constexpr double kFinest = 0.01;  ///< if smoothness is higher, corners are meant to be rounded

}  // namespace

bool OutlineFit::may_refine() const {
  return start_ && settings_.stiffness == 0 && settings_.smoothness <= kFinest;
}

bool OutlineFit::is_matched() const {
  return misses().total() <= 1;
}

OutlineFit::Misses OutlineFit::misses() const {
  const OutlineMatch match = after(iterations());
  const double accepted = kAccepted * target_.diameter() / std::abs(frame_.factor);
  return {match.zeros, match.hausdorff / accepted, match.pins_missed / accepted};
}

// The iterative solution is kept if it is better. Keeping the picture upright is optional: if the
// upright map fails to match, the least stretched map may still match.
void OutlineFit::refine() {
  const Misses before = misses();
  before_ = now_;
  follow_start(built_);
  const bool may_sharpen = !start_->is_near_crowded();
  if (may_sharpen && misses().total() > 1 && start_->use_sharp(true))
    follow_start(start_->last(held(pinned_)));
  Misses now = misses();
  if (may_sharpen && now.total() > 1 && settings_.upright > 0 && pins_.empty()) {
    const Correspondence upright = built_;
    follow_start(start_->least_stretched());
    if (const Misses free = misses(); free.total() < now.total())
      now = free;
    else
      follow_start(upright);
  }
  if (now.total() <= before.total()) return;
  before_ = {};
  build(built_);
  begin(built_, held(pinned_));
  run(AlternatingFit::Mode::first_order, kSettled, settings_.most_iterations);
}

std::vector<double> OutlineFit::vertex_lengths() const {
  std::vector<double> lengths;
  for (size_t i = 0; i < flat_.locations.size(); ++i)
    if (flat_.locations[i].t == 0) lengths.push_back(source_.length_at(static_cast<Index>(i), 0));
  return lengths;
}

// The vertices come from graded_cuts. They include all the cage's vertices and the preimages of the
// target's corners.
void OutlineFit::set_up_graded_basis(const Correspondence& start) {
  const double length = source_.length(), close = 1e-9 * length;
  std::vector<double> kept = vertex_lengths();
  const std::vector<double> own = kept;
  const Correspondence back = start.inverse();
  for (const double corner : corners_of(target_)) {
    const double at = back(corner), once = at - std::floor(at / length) * length;
    const bool is_new = std::ranges::all_of(kept, [&](double other) {
      return std::abs(other - once) > close && length - once > close;
    });
    if (is_new) kept.push_back(once);
  }
  std::ranges::sort(kept);
  CutRules rules;
  rules.length = length;
  rules.size = target_.diagonal();
  int degree = 1;
  for (Index e = 0; e < cage_.size(); ++e) degree = std::max(degree, cage_.degree(e));
  rules.longest *= degree;
  rules.bent *= degree;
  rules.most /= degree;
  constexpr double kLeastCurve = 1e-5;  // rounding would bend shorter pieces
  if (degree > 1) rules.least = kLeastCurve;
  const Thickness thickness(source_);
  constexpr double kOfThickness = 1.5;  // keeps pieces short relative to the local thickness
  cut_lengths_ = graded_cuts(
      kept, [&](double s) { return target_.at(start(s)); },
      [&](double s) { return kOfThickness * thickness(s); }, rules);
  std::vector<double> inner;
  std::ranges::set_difference(cut_lengths_, own, std::back_inserter(inner));
  const Cuts places = cuts_at(cage_, flat_, source_, std::move(inner));
  now_.basis = cut(cage_, places, 0);
  now_.given_basis = cut(given_, places, 0);
  cut_lengths_.push_back(length);
}

// The correspondence gives the targets. Each error is weighted by the inverse size of the image of
// the surrounding piece. Where images are small, f' is also small, so its relative error must be
// small for it to have no zeros.
void OutlineFit::follow_start(const Correspondence& start) {
  built_ = start;
  ++builds_;
  refined_ = true;
  set_up_graded_basis(start);
  set_up_samples();
  const std::vector<FitRow> rows = fit_rows(image_sizes());
  const VectorXc targets = graded_targets();
  const MatrixXc bends = coordinates_at(now_.basis, middles_, 2);
  MatrixXc left(static_cast<Index>(rows.size()), now_.basis.control_count());
  VectorXc right = VectorXc::Zero(left.rows());
  for (Index i = 0; i < left.rows(); ++i) {
    const auto [weight, row, is_bend] = rows[static_cast<size_t>(i)];
    if (is_bend) {
      const double size = sizes_[static_cast<size_t>(row)];
      left.row(i) = weight * size * size * bends.row(row);
    } else {
      left.row(i) = weight * now_.at_samples.row(row);
      right[i] = weight * targets[row];
    }
  }
  if (!is_straight(now_.basis)) add_ridge(left, right);
  now_.iterates = {least_squares(std::move(left), std::move(right))};
  now_.energies = {mean_square_miss() / (unit_ * unit_)};
}

/// If a function is holomorphic outside, the Cauchy integral of its boundary values is 0 inside,
/// and curves have enough freedom to add such values. Weak rows therefore tie the control points to
/// the images of boundary points near them under the correspondence.
void OutlineFit::add_ridge(MatrixXc& left, VectorXc& right) const {
  constexpr double kWeak = 1e-4;
  const Index rows = left.rows(), n = left.cols();
  left.conservativeResize(rows + n, n);
  right.conservativeResize(rows + n);
  left.bottomRows(n).setZero();
  const VectorXd sizes = image_sizes();
  for (Index e = 0; e < now_.basis.size(); ++e)
    for (int m = 0; m < now_.basis.degree(e); ++m) {
      const Index c = now_.basis.control_offset(e) + m, row = rows + c;
      const double fraction = static_cast<double>(m) / now_.basis.degree(e);
      const size_t i = static_cast<size_t>(e);
      const double length = (1 - fraction) * cut_lengths_[i] + fraction * cut_lengths_[i + 1];
      left(row, c) = kWeak / sizes[e];
      right[row] = left(row, c) * (target_.at(built_(length)) - center_);
    }
}

/// The lengths of the images of the pieces of the basis.
VectorXd OutlineFit::image_sizes() const {
  constexpr double kLeast = 1e-13;  // over the target's diagonal; smaller sizes are rounding errors
  VectorXd sizes(now_.basis.size());
  const auto image = [&](Index e) {
    return target_.at(built_(cut_lengths_[static_cast<size_t>(e)]));
  };
  for (Index e = 0; e < sizes.size(); ++e)
    sizes[e] = std::max(kLeast * target_.diagonal(), std::abs(image(e + 1) - image(e)));
  return sizes;
}

/// Rows for the samples and for f'', in order of decreasing weight, as least_squares requires.
std::vector<OutlineFit::FitRow> OutlineFit::fit_rows(const VectorXd& sizes) const {
  std::vector<FitRow> rows;
  const Index n = sizes.size();
  constexpr size_t kStride = 2;  // every second sample: the same quality in half the time
  for (size_t i = 0; i < samples_.size(); i += kStride) {
    const Index e = samples_[i].segment;
    const double size = samples_[i].t == 0 ? std::min(sizes[e], sizes[(e + n - 1) % n]) : sizes[e];
    rows.push_back({1 / size, static_cast<Index>(i), false});
  }
  const double smooth = std::sqrt(settings_.smoothness * static_cast<double>(samples_.size()) /
                                  static_cast<double>(middles_.size()));
  for (size_t i = 0; i < middles_.size() && smooth > 0; ++i)
    rows.push_back({smooth / sizes[middles_[i].segment], static_cast<Index>(i), true});
  std::ranges::sort(rows, std::greater{}, &FitRow::weight);
  return rows;
}

double OutlineFit::mean_square_miss() const {
  const VectorXc values = now_.at_samples * now_.iterates.back();
  double sum = 0;
  for (const Complex& z : values)
    sum += std::norm(z + center_ - target_.nearest(z + center_).point);
  return sum / static_cast<double>(values.size());
}

VectorXc OutlineFit::graded_targets() const {
  VectorXc targets(static_cast<Index>(samples_.size()));
  for (Index i = 0; i < targets.size(); ++i) {
    const BoundaryPoint& at = samples_[static_cast<size_t>(i)];
    const size_t e = static_cast<size_t>(at.segment);
    double length = (1 - at.t) * cut_lengths_[e] + at.t * cut_lengths_[e + 1];
    if (!is_straight(now_.basis, at.segment)) {
      const Polyline::Nearest near = source_.nearest(position_of(now_.basis, at));
      length = source_.length_at(near.segment, near.parameter);
    }
    targets[i] = target_.at(built_(length)) - center_;
  }
  return targets;
}

}  // namespace holomorph
