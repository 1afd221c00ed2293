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
constexpr int kDraftSteps = 2, kFinalSteps = 200, kNextSteps = 60;
constexpr double kClosing = 1e8;  ///< leaves gaps of about 1e-8 of the size
/// The largest gap of a certified map, and a gap that needs no closing, relative to the size.
constexpr double kClosed = 1e-6, kNoGap = 1e-8;
constexpr double kEstimate = 1e-5;  ///< the relative decrement that ends an estimate
constexpr double kFarPin = 1e-3;    ///< relative to the size: a miss that needs second derivatives
constexpr int kSingleFrom =
    100;  ///< from this size on, drafts compute Hessians in single precision
/// The weights of the barrier, relative to the value without it: at the start of a final answer, at
/// the start with more samples, at the end, and in drafts. A fixed weight would be too thin where
/// pins are missed and the penalty is large.
constexpr double kFirstBarrier = 1e-1, kNextBarrier = 1e-3, kLastBarrier = 1e-5,
                 kDraftBarrier = 1e-3;
constexpr double kTightened = 0.002;  ///< so that the bounds themselves can be proved

}  // namespace

IsometricSpace::IsometricSpace(std::shared_ptr<const BoundaryBasis> basis, const Mesh& mesh,
                               IsometricHandles handles, const std::vector<AreaSample>& inner,
                               const Stiffness& stiffness, IsometricEnergy energy,
                               const std::optional<Bounds>& bounds)
    : basis_(std::move(basis)),
      handles_(std::move(handles)),
      bounds_(bounds),
      size_(box_of(basis_->samples()).diagonal()),
      certifier_(*basis_),
      loops_(mesh, basis_->polygon()) {
  auto system = std::make_shared<IsometricSystem>();
  system->energy = energy;
  if (bounds_) {
    bounds_->check_usable();
    if (!(bounds_->k > 0)) throw Error(ErrorKind::bad_input, "the angle bound k must be positive");
    system->barrier.emplace(bounds_->tightened(kTightened));
  }
  const Index m = static_cast<Index>(basis_->samples().size()),
              k = static_cast<Index>(inner.size());
  real_columns(basis_->at_samples(), system->re, system->im);
  system->weights.resize(m + k);
  system->weights.head(m) = basis_->sample_weights();
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
  system->paths = PathTree(mesh, basis_->polygon(), handles_.stations, loops_.paths());
  system->closing = kClosing / (size_ * size_);
  system->nodes = basis_->whitened(basis_->values(system->paths.nodes()));
  system->nodes_by_column.re = system->nodes.real().transpose();
  system->nodes_by_column.im = system->nodes.imag().transpose();
  system->station_weights = handles_.weights;
  system->frames = basis_->whitened(basis_->values(handles_.frames));
  system->frame_weights = handles_.frame_weights;
  at_stations_ = basis_->whitened(basis_->values(handles_.stations));

  const Index rows = system->re.rows();
  normal_ = kTurnRidge * MatrixXd::Identity(rows, rows);
  const MatrixXd u = system->re * system->weights.cwiseSqrt().asDiagonal();
  add_gram(u, u.cols(), 0, normal_);
  system_ = std::move(system);
}

double IsometricSpace::penalty(const Settings& settings) const {
  return settings.pin_weight / (size_ * size_);
}

LogMap IsometricSpace::map_of(const VectorXd& x) const {
  const Index n = basis_->unknowns();
  return {basis_->coefficients(complex_of(x.head(2 * n))),
          basis_->coefficients(complex_of(x.tail(2 * n)))};
}

/// The l that minimizes the mean of u^2 with the known turns as penalties, and nu = 0.
VectorXd IsometricSpace::start(const Turns& turns) const {
  check(static_cast<Index>(turns.size()) == handles_.turned,
        "isometric space: one turn for each station that has one");
  MatrixXd re, im;
  real_columns(at_stations_.topRows(handles_.turned), re, im);
  VectorXd known(im.cols());
  Index count = 0;
  for (size_t i = 0; i < turns.size(); ++i) {
    if (!turns[i]) continue;
    im.col(count) = std::sqrt(kTurnWeight) * im.col(static_cast<Index>(i));
    known[count++] = std::sqrt(kTurnWeight) * *turns[i];
  }
  MatrixXd normal = normal_;
  add_gram(im, count, 0, normal);
  Cholesky cholesky;
  check(cholesky.factor(normal), "isometric space: the energy of turns is definite");
  VectorXd x = VectorXd::Zero(system_->unknowns());
  x.head(2 * basis_->unknowns()) = cholesky.solve(im.leftCols(count) * known.head(count));
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
  x.head(2 * basis_->unknowns()) = stacked(angle * kI * basis_->one());
  return x;
}

/// The mean energy of a conformal map, nu = 0.
double IsometricSpace::conformal_energy(const VectorXd& x) const {
  const VectorXd u = transposed_product(system_->re, x.head(2 * basis_->unknowns()));
  double sum = 0;
  for (Index i = 0; i < u.size(); ++i)
    sum += system_->weights[i] * IsometricEnergy{}.value(u[i], 0, 0);
  return sum / system_->weights.sum();
}

/// A map near x that is inside the bounds and has no gaps. Without bounds and holes, that is the
/// conformal part of x. Otherwise, it is a similarity with the mean turn of x and a size that the
/// bounds allow.
VectorXd IsometricSpace::center(const VectorXd& x) const {
  const Index rows = 2 * basis_->unknowns();
  VectorXd result = VectorXd::Zero(x.size());
  if (!bounds_ && loops_.paths().empty()) {
    result.head(rows) = x.head(rows);
    return result;
  }
  const double u = bounds_ && (bounds_->sigma >= 1 || bounds_->Sigma <= 1) ? bounds_->middle() : 0,
               turn = transposed_product(system_->im, x.head(rows)).mean();
  if (u != 0 || turn != 0) result.head(rows) = stacked(Complex(u, turn) * basis_->one());
  return result;
}

/// Moves x toward its center until |nu| < 1 and the bounds hold at all samples.
VectorXd IsometricSpace::moved_inside(const IsometricSystem& system, VectorXd x) const {
  if (is_inside(system, x)) return x;
  const VectorXd safe = center(x);
  for (double part = 1.0 / 1024; part < 1; part *= 2)
    if (VectorXd moved = x + part * (safe - x); is_inside(system, moved)) return moved;
  return is_inside(system, safe) ? safe : VectorXd::Zero(x.size());
}

/// The value at x without the barrier.
double IsometricSpace::free_value(const IsometricSystem& system, const IsometricTarget& target,
                                  IsometricSettings settings, const VectorXd& x) const {
  settings.iterations = 0;
  settings.barrier = 1;
  const IsometricSolution at = minimized(system, target, settings, x);
  return at.total - at.barrier;
}

/// Minimizes from the nearest start inside the bounds. The barrier's weight decreases from round to
/// round; it starts at the given fraction of the value without the barrier.
IsometricSolution IsometricSpace::within(const IsometricSystem& system,
                                         const IsometricTarget& target, IsometricSettings steps,
                                         VectorXd x, double barrier) const {
  if (!bounds_) return minimized(system, target, steps, std::move(x));
  constexpr double kRough = 1e-4, kFine = 1e-8;
  constexpr int kRoughSteps = 12, kFineSteps = 30;
  IsometricSettings rough = steps;
  rough.tolerance = kRough;
  rough.iterations = kRoughSteps;
  rough.far = std::numeric_limits<double>::infinity();
  steps.tolerance = kFine;
  steps.iterations = kFineSteps;
  IsometricSolution solution;
  solution.x = moved_inside(system, std::move(x));
  int iterations = 0;
  for (bool last = false; !last; barrier *= 0.1) {
    last = barrier < 2 * kLastBarrier;
    IsometricSettings& now = last ? steps : rough;
    now.barrier = barrier * free_value(system, target, now, solution.x);
    solution = minimized(system, target, now, std::move(solution.x));
    iterations += solution.iterations;
  }
  solution.iterations = iterations;
  return solution;
}

/// A barrier that is too thin for where the map is makes steps short, and one that is thicker than
/// necessary keeps the map away from the bounds.
double IsometricSpace::draft_barrier(const IsometricTarget& target,
                                     const IsometricMap& from) const {
  constexpr double kShort = 0.1, kThicker = 10, kThinner = 0.3;
  if (from.solution.step < kShort) return std::min(kThicker * from.barrier, kFirstBarrier);
  if (from.target != target.stations) return std::max(from.barrier, kDraftBarrier);
  return std::max(kThinner * from.barrier, kLastBarrier);
}

Extremes IsometricSpace::extremes(const LogMap& map) const {
  Extremes found = certifier_.extremes(map);
  if (!bounds_) return found;
  found.shear = std::min(found.shear, bounds_->k);
  found.smallest = std::max(found.smallest, bounds_->sigma);
  found.largest = std::min(found.largest, bounds_->Sigma);
  return found;
}

Certificate IsometricSpace::certify(const LogMap& map) const {
  constexpr double kBelowOne = 1 - 1e-9;
  constexpr int kDepth = 8;
  return certifier_.certify(
      map, bounds_.value_or(Bounds{kBelowOne, 0, std::numeric_limits<double>::infinity()}), kDepth);
}

/// Closes the gaps and tries to prove the map.
void IsometricSpace::prove(const IsometricTarget& target, IsometricMap& map) const {
  if (!loops_.paths().empty()) {
    IsometricSettings settings;
    settings.barrier = 1;
    const int iterations = map.solution.iterations;
    const bool converged = map.solution.converged;
    map.solution = closed(*system_, target, settings, std::move(map.solution.x), kNoGap * size_);
    map.solution.iterations = iterations;
    map.solution.converged = converged;
  }
  map.map = map_of(map.solution.x);
  map.certificate = certify(map.map);
  if (!loops_.paths().empty() && map.solution.gaps.cwiseAbs().maxCoeff() > kClosed * size_)
    map.certificate.holds = false;
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
void IsometricSpace::retreat(const IsometricTarget& target, const VectorXd& certified,
                             IsometricMap& map) const {
  const VectorXd x = map.solution.x;
  map.solution.converged = false;
  constexpr int kHalvings = 8;
  double part = 0, step = 0.5;
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    map.solution.x = certified + (part + step) * (x - certified);
    prove(target, map);
    if (map.certificate.holds) part += step;
  }
  if (map.certificate.holds) return;
  map.solution.x = certified + part * (x - certified);
  prove(target, map);
}

void IsometricSpace::finish(const IsometricTarget& target, IsometricMap& map) const {
  const VectorXc l = at_stations_.topRows(handles_.turned) *
                     complex_of(map.solution.x.head(2 * basis_->unknowns()));
  map.target = target.stations;
  map.turns.assign(l.size(), {});
  for (Index i = 0; i < l.size(); ++i) map.turns[static_cast<size_t>(i)] = l[i].imag();
  IsometricSettings nothing;
  nothing.iterations = 0;
  nothing.barrier = 1;
  const IsometricSolution now = minimized(*system_, target, nothing, map.solution.x);
  map.solution.offsets = now.offsets;
  map.solution.gaps = now.gaps;
  map.solution.move = now.move;
  map.solution.energy = now.energy;
}

IsometricMap IsometricSpace::solved(const IsometricTarget& target, const Settings& settings,
                                    const Turns& turns) const {
  IsometricSettings steps;
  steps.far = kFarPin * size_;
  steps.stop = settings.stop;
  IsometricMap map;
  map.system = system_;
  VectorXd x;
  int iterations = 0;
  const bool known = std::ranges::any_of(turns, [](const auto& turn) { return turn.has_value(); });
  if (known) x = start(turns);
  if (!known || !(conformal_energy(x) <= kWildest)) {
    x = rotated(target);
    if (bounds_) x = moved_inside(*system_, std::move(x));
    steps.iterations = 1;
    for (double part = 1e-6; part < 0.5; part *= 10) {
      steps.penalty = part * penalty(settings);
      if (bounds_) steps.barrier = kFirstBarrier * free_value(*system_, target, steps, x);
      IsometricSolution next = minimized(*system_, target, steps, std::move(x));
      x = std::move(next.x);
      iterations += next.iterations;
    }
  }
  steps.penalty = penalty(settings);
  steps.iterations = settings.estimates ? kNextSteps : kFinalSteps;
  if (settings.estimates) steps.tolerance = kEstimate;
  IsometricTarget shifted = target;
  constexpr int kRounds = 8;
  constexpr double kMet = 1e-10;
  for (int round = 0; round < (settings.exact ? kRounds : 1); ++round) {
    map.solution = within(*map.system, shifted, steps, std::move(x), kFirstBarrier);
    iterations += map.solution.iterations;
    x = map.solution.x;
    if (!settings.exact || target.stations.size() == 0) break;
    const VectorXc miss = map.solution.offsets + shifted.stations - target.stations;
    if (miss.cwiseAbs().maxCoeff() <= kMet * size_) break;
    shifted.stations -= miss;
  }
  prove(target, map);
  // Active bounds need many samples. It is cheaper to retreat from the last few violations.
  const int cuts = settings.estimates ? 0 : bounds_ ? 2 : 6;
  steps.iterations = kNextSteps;
  for (int cut = 0; !map.certificate.holds && cut < cuts; ++cut) {
    map.system = with_samples(*map.system, map.certificate.unproved);
    // The new samples must start inside.
    VectorXd start = moved_inside(*map.system, std::move(map.solution.x));
    map.solution = within(*map.system, shifted, steps, std::move(start), kNextBarrier);
    iterations += map.solution.iterations;
    prove(target, map);
  }
  if (!map.certificate.holds) retreat(target, center(map.solution.x), map);
  map.solution.iterations = iterations;
  map.barrier = kLastBarrier;
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
  const VectorXd start = moved_inside(*map.system, from.solution.x);
  map.barrier = draft_barrier(target, from);
  if (bounds_) steps.barrier = map.barrier * free_value(*map.system, target, steps, start);
  map.solution = minimized(*map.system, target, steps, start);
  prove(target, map);
  if (!map.certificate.holds) {
    map.system = with_samples(*map.system, map.certificate.unproved);
    retreat(target, from.solution.x, map);
  }
  finish(target, map);
  return map;
}

}  // namespace holomorph
