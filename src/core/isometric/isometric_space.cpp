// Without known turns, the penalty of the stations grows over the first steps. Without that growth,
// the iteration often ends in a worse minimum.
#include "core/isometric/isometric_space.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr double kTurnWeight = 300, kTurnRidge = 1e-6;
/// A start with a larger energy does not come from a drag. The turns of neighboring pins contradict
/// each other, perhaps in a damaged file.
constexpr double kWildest = 1e4;
constexpr int kDraftSteps = 2, kFinalSteps = 200;
constexpr double kFarPin = 1e-3;  ///< relative to the size: a miss that needs second derivatives
constexpr int kSingleFrom =
    100;  ///< from this size on, drafts compute Hessians in single precision

/// Half the lengths of the pieces next to each sample, divided by the sum.
VectorXd boundary_weights(const BoundaryBasis& basis) {
  const Index m = static_cast<Index>(basis.samples().size());
  VectorXd weights = VectorXd::Zero(m);
  for (Index i = 0; i < m; ++i) {
    const BoundaryPiece& piece = basis.pieces()[static_cast<size_t>(i)];
    const double half = 0.5 * std::abs(piece.end - piece.start);
    weights[i] += half;
    weights[(i + 1) % m] += half;
  }
  return weights / weights.sum();
}

}  // namespace

IsometricSpace::IsometricSpace(std::shared_ptr<const BoundaryBasis> basis, const Mesh& mesh,
                               IsometricHandles handles, const std::vector<AreaSample>& inner,
                               const Stiffness& stiffness, IsometricEnergy energy)
    : basis_(std::move(basis)),
      handles_(std::move(handles)),
      size_(box_of(basis_->samples()).diagonal()),
      certifier_(*basis_) {
  auto system = std::make_shared<IsometricSystem>();
  system->energy = energy;
  const Index m = static_cast<Index>(basis_->samples().size()),
              k = static_cast<Index>(inner.size());
  real_columns(basis_->at_samples(), system->re, system->im);
  system->weights.resize(m + k);
  system->weights.head(m) = boundary_weights(*basis_);
  if (k > 0) {
    Points points;
    for (Index i = 0; i < k; ++i) {
      points.push_back(mesh.vertices[static_cast<size_t>(inner[static_cast<size_t>(i)].vertex)]);
      system->weights[m + i] = inner[static_cast<size_t>(i)].area;
    }
    MatrixXd re, im;
    real_columns(basis_->whitened(basis_->values(points)), re, im);
    append_columns(re, system->re);
    append_columns(im, system->im);
    system->weights.head(m) *= 0.5;
    system->weights.tail(k) *= 0.5 / system->weights.tail(k).sum();
  }
  if (stiffness.size() > 0) system->weights = system->weights.cwiseProduct(stiffness).eval();
  system->paths = PathTree(mesh, basis_->polygon(), handles_.stations);
  system->nodes = basis_->whitened(basis_->values(system->paths.nodes()));
  system->nodes_by_column.re = system->nodes.real().transpose();
  system->nodes_by_column.im = system->nodes.imag().transpose();
  system->station_weights = handles_.weights;
  system->frames = basis_->whitened(basis_->values(handles_.frames));
  system->frame_weights = handles_.frame_weights;
  at_stations_ = basis_->whitened(basis_->values(handles_.stations));

  const Index rows = system->re.rows();
  MatrixXd normal = kTurnRidge * MatrixXd::Identity(rows, rows);
  const MatrixXd u = system->re * system->weights.cwiseSqrt().asDiagonal();
  add_gram(u, u.cols(), 0, normal);
  MatrixXd re, im;
  real_columns(at_stations_.topRows(handles_.turned), re, im);
  im *= std::sqrt(kTurnWeight);
  add_gram(im, im.cols(), 0, normal);
  check(from_turns_.factor(normal), "isometric space: the energy of turns is definite");
  system_ = std::move(system);
}

double IsometricSpace::penalty(const Settings& settings) const {
  return settings.pin_weight / (size_ * size_);
}

LogMap IsometricSpace::map_of(const VectorXd& x) const {
  const Index n = basis_->size();
  return {basis_->coefficients(complex_of(x.head(2 * n))),
          basis_->coefficients(complex_of(x.tail(2 * n)))};
}

VectorXd IsometricSpace::start(const VectorXd& turns) const {
  check(turns.size() == handles_.turned, "isometric space: one turn for each station that has one");
  MatrixXd re, im;
  real_columns(at_stations_.topRows(handles_.turned), re, im);
  VectorXd x = VectorXd::Zero(system_->unknowns());
  x.head(2 * basis_->size()) = from_turns_.solve(kTurnWeight * (im * turns));
  return x;
}

VectorXd IsometricSpace::rotated(const IsometricTarget& target) const {
  // The best rotation between stations and targets, relative to their weighted means.
  const double all = handles_.weights.sum();
  Complex from = 0, to = 0, both = 0;
  const Index count = target.stations.size();
  const auto rest = [&](Index i) { return handles_.stations[static_cast<size_t>(i)]; };
  for (Index i = 0; i < count; ++i) {
    from += handles_.weights[i] / all * rest(i);
    to += handles_.weights[i] / all * (rest(i) + target.stations[i]);
  }
  for (Index i = 0; i < count; ++i)
    both += handles_.weights[i] * std::conj(rest(i) - from) * (rest(i) + target.stations[i] - to);
  VectorXd x = VectorXd::Zero(system_->unknowns());
  // Rounding must not rotate a picture at rest.
  const bool is_rest = target.stations.isZero(0);
  double angle = is_rest || both == Complex(0) ? 0 : std::arg(both);
  if (count < 2 && target.frames.size() > 0) angle = target.frames.imag().mean();
  x.head(2 * basis_->size()) = stacked(angle * kI * basis_->one());
  return x;
}

/// The mean energy of a conformal map, nu = 0.
double IsometricSpace::conformal_energy(const VectorXd& x) const {
  const VectorXd u = transposed_product(system_->re, x.head(2 * basis_->size()));
  double sum = 0;
  for (Index i = 0; i < u.size(); ++i)
    sum += system_->weights[i] * system_->energy.value(u[i], 0, 0);
  return sum / system_->weights.sum();
}

Certificate IsometricSpace::certify(const LogMap& map) const {
  constexpr double kBelowOne = 1 - 1e-9;
  constexpr int kDepth = 8;
  return certifier_.certify(map, {kBelowOne, 0, std::numeric_limits<double>::infinity()}, kDepth);
}

void IsometricSpace::prove(IsometricMap& map) const {
  map.map = map_of(map.solution.x);
  map.certificate = certify(map.map);
}

std::shared_ptr<const IsometricSystem> IsometricSpace::with_samples(const IsometricSystem& system,
                                                                    const Points& points) const {
  auto more = std::make_shared<IsometricSystem>(system);
  MatrixXd re, im;
  real_columns(basis_->whitened(basis_->values(points)), re, im);
  append_columns(re, more->re);
  append_columns(im, more->im);
  const Index before = more->weights.size(), count = re.cols();
  // The energy acts as a barrier, so a small weight suffices.
  constexpr double kLittle = 0.1;
  more->weights.conservativeResize(before + count);
  more->weights.tail(count).setConstant(kLittle * system_->weights.mean());
  return more;
}

/// Moves a solution toward one that is known to be certified until it is certified, too.
void IsometricSpace::retreat(const VectorXd& certified, IsometricMap& map) const {
  const VectorXd x = map.solution.x;
  map.solution.offsets.resize(0);  // they belong to another x
  for (double part = 0.5; !map.certificate.holds && part > 1e-3; part *= 0.5) {
    map.solution.x = certified + part * (x - certified);
    map.solution.converged = false;
    prove(map);
  }
  if (map.certificate.holds) return;
  map.solution.x = certified;
  prove(map);
}

void IsometricSpace::finish(const IsometricTarget& target, IsometricMap& map) const {
  map.turns = (at_stations_ * complex_of(map.solution.x.head(2 * basis_->size()))).imag();
  if (map.solution.offsets.size() == target.stations.size()) return;
  IsometricSettings nothing;
  nothing.iterations = 0;
  const IsometricSolution now = minimized(*map.system, target, nothing, map.solution.x);
  map.solution.offsets = now.offsets;
  map.solution.move = now.move;
  map.solution.energy = now.energy;
}

IsometricMap IsometricSpace::solved(const IsometricTarget& target, const Settings& settings,
                                    const VectorXd& turns) const {
  IsometricSettings steps;
  steps.far = kFarPin * size_;
  steps.stop = settings.stop;
  IsometricMap map;
  map.system = system_;
  VectorXd x;
  int iterations = 0;
  if (turns.size() > 0) x = start(turns);
  if (turns.size() == 0 || !(conformal_energy(x) <= kWildest)) {
    x = rotated(target);
    steps.iterations = 1;
    for (double part = 1e-6; part < 0.5; part *= 10) {
      steps.penalty = part * penalty(settings);
      IsometricSolution next = minimized(*system_, target, steps, std::move(x));
      x = std::move(next.x);
      iterations += next.iterations;
    }
  }
  steps.penalty = penalty(settings);
  steps.iterations = kFinalSteps;
  IsometricTarget shifted = target;
  constexpr int kRounds = 8;
  constexpr double kMet = 1e-10;
  for (int round = 0; round < (settings.exact ? kRounds : 1); ++round) {
    map.solution = minimized(*map.system, shifted, steps, std::move(x));
    iterations += map.solution.iterations;
    x = map.solution.x;
    if (!settings.exact || target.stations.size() == 0) break;
    const VectorXc miss = map.solution.offsets + shifted.stations - target.stations;
    if (miss.cwiseAbs().maxCoeff() <= kMet * size_) break;
    shifted.stations -= miss;
  }
  prove(map);
  constexpr int kCuts = 6;
  for (int cut = 0; !map.certificate.holds && cut < kCuts; ++cut) {
    map.system = with_samples(*map.system, map.certificate.unproved);
    // The new samples must start inside |nu| < 1.
    VectorXd inside = map.solution.x;
    const auto is_inside = [&](const VectorXd& at) {
      const VectorXd a = transposed_product(map.system->re, at.tail(2 * basis_->size())),
                     b = transposed_product(map.system->im, at.tail(2 * basis_->size()));
      return (a.array().square() + b.array().square()).maxCoeff() < 1;
    };
    while (!is_inside(inside)) inside.tail(2 * basis_->size()) *= 0.95;
    map.solution = minimized(*map.system, shifted, steps, std::move(inside));
    iterations += map.solution.iterations;
    prove(map);
  }
  if (!map.certificate.holds) {
    VectorXd conformal = map.solution.x;
    conformal.tail(2 * basis_->size()).setZero();
    retreat(conformal, map);
  }
  map.solution.iterations = iterations;
  if (settings.exact) map.solution.offsets.resize(0);  // they belong to shifted targets
  finish(target, map);
  return map;
}

IsometricMap IsometricSpace::followed(const IsometricTarget& target, const Settings& settings,
                                      const IsometricMap& from) const {
  IsometricSettings steps;
  steps.penalty = penalty(settings);
  steps.iterations = kDraftSteps;
  steps.single = basis_->size() >= kSingleFrom;
  IsometricMap map;
  map.system = from.system;
  map.solution = minimized(*map.system, target, steps, from.solution.x);
  prove(map);
  if (!map.certificate.holds) {
    map.system = with_samples(*map.system, map.certificate.unproved);
    retreat(from.solution.x, map);
  }
  finish(target, map);
  return map;
}

}  // namespace holomorph
