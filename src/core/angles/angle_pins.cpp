// Each iteration minimizes |D (x - x_0)| subject to the linearized pins: x = x_0 + S A^T lambda,
// where S = (D^T D)^-1 and the rows of A are the pins' derivatives. The unknowns x are the angles,
// the logarithm of the scale, and the translation. Each corner that reaches the smallest angle is
// held there by an additional row.
#include "core/angles/angle_pins.h"

#include <algorithm>

#include "core/angles/boundary_angles.h"
#include "core/solvers/factors.h"

namespace holomorph {
namespace {

constexpr int kMostIterations = 40, kDraftIterations = 3, kMostHalvings = 5;
constexpr double kMostStep = 0.5;  ///< largest change of an angle per iteration, in radians
constexpr double kSolved = 1e-9;   ///< largest residual or step, relative to the size or in radians
constexpr double kMeanAngleWeight = 0.05;  ///< weight of the mean angle relative to jumps and bends
constexpr double kScaleWeight = 0.05, kTranslationWeight = 0.05;

/// (D^T D)^-1, where D penalizes jumps, bends, and the rotation, scale and translation of the whole
/// map.
MatrixXd inverse_penalty(Index corners, double size) {
  const Index n = 2 * corners;
  MatrixXd held = MatrixXd::Zero(n + 4, n + 3);
  for (Index j = 0; j < corners; ++j) {
    held(2 * j, 2 * j) = -1;  // the corner's jump
    held(2 * j, 2 * j + 1) = 1;
    held(2 * j + 1, 2 * j + 1) = -1;  // the bend of the edge after it
    held(2 * j + 1, (2 * j + 2) % n) = 1;
  }
  held.row(n).head(n).setConstant(kMeanAngleWeight / static_cast<double>(n));
  held(n + 1, n) = kScaleWeight;
  held(n + 2, n + 1) = held(n + 3, n + 2) = kTranslationWeight / size;
  return solve_symmetric_all(held.transpose() * held, MatrixXd::Identity(n + 3, n + 3));
}

Points positions_of(const std::vector<RestPin>& pins, bool turning_only) {
  Points positions;
  for (const RestPin& pin : pins)
    if (pin.has_frame || !turning_only) positions.push_back(pin.position);
  return positions;
}

}  // namespace

AnglePins::AnglePins(const Mesh& mesh, std::shared_ptr<const HilbertCoordinates> coordinates,
                     std::vector<Index> corners, std::vector<RestPin> pins)
    : coordinates_(std::move(coordinates)),
      corners_(std::move(corners)),
      pins_(std::move(pins)),
      size_(box_of(mesh.vertices).diagonal()),
      map_(mesh, coordinates_, positions_of(pins_, false), Precision::full),
      rows_(map_.rows(positions_of(pins_, true))),
      inverse_penalty_(inverse_penalty(static_cast<Index>(corners_.size()), size_)) {}

double AnglePins::largest_jump(size_t corner) const {
  const double inner = coordinates_->angle(corners_[corner]);
  return inner - std::min(kLeastCornerAngle, inner);
}

AnglePins::Linear AnglePins::linear_at(const VectorXd& x, const std::vector<PosePin>& targets) {
  const Index n = x.size() - 3, pins = static_cast<Index>(pins_.size()), turning = rows_.rows(),
              held = std::ranges::count(held_, 1);
  const VectorXd theta = x.head(n);
  const double scale = std::exp(x[n]);
  Linear linear{VectorXd(2 * (pins + turning) + held),
                MatrixXd::Zero(2 * (pins + turning) + held, n + 3)};
  auto& [off, by, largest_miss] = linear;
  VectorXc f;
  map_.map(theta, f);
  const MatrixXc jacobian = scale / size_ * map_.jacobian();
  for (Index i = 0; i < pins; ++i) {
    const Complex way =
        targets[static_cast<size_t>(i)].position - (scale * f[i] + Complex(x[n + 1], x[n + 2]));
    largest_miss = std::max(largest_miss, std::abs(way));
    off.segment(2 * i, 2) << way.real() / size_, way.imag() / size_;
    by.row(2 * i).head(n) = jacobian.row(i).real();
    by.row(2 * i + 1).head(n) = jacobian.row(i).imag();
    by(2 * i, n) = scale / size_ * f[i].real();
    by(2 * i + 1, n) = scale / size_ * f[i].imag();
    by(2 * i, n + 1) = by(2 * i + 1, n + 2) = 1 / size_;
  }
  // log f' = i H theta + log scale is linear in the unknowns.
  for (Index i = 0, row = 2 * pins; i < pins; ++i) {
    if (!pins_[static_cast<size_t>(i)].has_frame) continue;
    const PosePin& target = targets[static_cast<size_t>(i)];
    const Index number = (row - 2 * pins) / 2;
    by.row(row).head(n) = rows_.row(number).real();
    by.row(row + 1).head(n) = -rows_.row(number).imag();
    by(row + 1, n) = 1;
    off[row] = std::remainder(target.angle - by.row(row).dot(x), 2 * kPi);
    off[row + 1] = std::log(target.scale) - by.row(row + 1).dot(x);
    row += 2;
  }
  Index row = 2 * (pins + turning);
  for (size_t j = 0; j < corners_.size(); ++j) {
    if (!held_[j]) continue;
    const Index before = 2 * static_cast<Index>(j);
    by(row, before) = -1;
    by(row, before + 1) = 1;
    off[row++] = largest_jump(j) - (theta[before + 1] - theta[before]);
  }
  return linear;
}

AnglePins::Answer AnglePins::pull(const std::vector<PosePin>& targets, bool draft,
                                  const VectorXd* from, PlacedAngles& placed) {
  const Index n = placed.theta.size();
  VectorXd start(n + 3);
  start << placed.theta, std::log(placed.scale), placed.move.real(), placed.move.imag();
  VectorXd x = draft && from && from->size() == start.size() ? *from : start, step;
  held_.assign(corners_.size(), 0);
  Answer answer;
  double least = INFINITY;
  for (int halved = 0;;) {
    const Linear linear = linear_at(x, targets);
    const double off = linear.off.cwiseAbs().maxCoeff();
    // Far from a solution, a full step may increase the residual.
    if (off > 1.2 * least && halved < kMostHalvings) {
      ++halved;
      step *= 0.5;
      x -= step;
      continue;
    }
    halved = 0;
    least = std::min(least, off);
    answer.largest_miss = linear.largest_miss;
    answer.settled = off <= kSolved ||
                     (answer.iterations > 0 && step.head(n + 1).cwiseAbs().maxCoeff() <= kSolved);
    if (answer.settled || answer.iterations == (draft ? kDraftIterations : kMostIterations)) break;
    ++answer.iterations;
    const MatrixXd soft = inverse_penalty_ * linear.by.transpose();
    MatrixXd gram = linear.by * soft;
    gram.diagonal().array() += 1e-13 * gram.diagonal().maxCoeff();
    step = start + soft * solve_symmetric(gram, linear.off + linear.by * (x - start)) - x;
    step *= std::min(1.0, kMostStep / std::max(1e-12, step.head(n + 1).cwiseAbs().maxCoeff()));
    for (size_t j = 0; j < corners_.size(); ++j) {
      const Index before = 2 * static_cast<Index>(j), after = before + 1;
      const double over = x[after] - x[before] + step[after] - step[before] - largest_jump(j);
      if (over <= 1e-12) continue;
      held_[j] = 1;
      step[after] -= over / 2;
      step[before] += over / 2;
    }
    x += step;
  }
  answer.unknowns = x.allFinite() ? x : start;
  placed = {x.head(n), std::exp(x[n]), {x[n + 1], x[n + 2]}};
  for (size_t j = 0; j < corners_.size(); ++j)
    if (held_[j]) answer.limited.push_back(corners_[j]);
  return answer;
}

}  // namespace holomorph
