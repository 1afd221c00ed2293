#include "core/methods/sheet_solver.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/geometry/stiffness.h"

namespace holomorph {
namespace {

std::shared_ptr<const SheetDomain> domain_of(const Rest& rest) {
  std::vector<char> framed;
  if (rest.frame != Frame::free) framed = boundary_marks(*rest.mesh);
  return std::make_shared<const SheetDomain>(rest.mesh, std::move(framed));
}

std::shared_ptr<const SheetEnergy> energy_of(const Rest& rest, const SheetDomain& domain,
                                             double roundness) {
  constexpr double kLeast = 0.006, kMost = 0.08;  // of the size, with the usual roundness
  const double most = kMost * std::max(1.0, roundness / 0.5);
  const Mesh& mesh = *domain.mesh;
  VectorXd stiffness(static_cast<Index>(mesh.triangles.size())),
      bending(static_cast<Index>(mesh.vertices.size()));
  for (Index i = 0; i < stiffness.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[static_cast<size_t>(i)];
    const Complex center =
        (mesh.vertices[static_cast<size_t>(a)] + mesh.vertices[static_cast<size_t>(b)] +
         mesh.vertices[static_cast<size_t>(c)]) /
        3.0;
    stiffness[i] = std::pow(10, stiffness_level(rest.stiffness, center));
  }
  for (Index v = 0; v < bending.size(); ++v)
    bending[v] = std::clamp(roundness * domain.width.at(mesh.vertices[static_cast<size_t>(v)]),
                            kLeast * domain.size, most * domain.size);
  return std::make_shared<const SheetEnergy>(domain.mesh, std::move(stiffness), bending);
}

}  // namespace

SheetSolver::SheetSolver(const Rest& rest, const Settings& settings, const SheetSolver* previous)
    : settings_(settings),
      stiffness_(rest.stiffness),
      domain_(previous && previous->domain_->mesh == rest.mesh &&
                      previous->domain_->framed.empty() == (rest.frame == Frame::free)
                  ? previous->domain_
                  : domain_of(rest)),
      energy_(previous && previous->domain_->mesh == rest.mesh &&
                      previous->stiffness_ == stiffness_ &&
                      previous->settings_.roundness == settings.roundness
                  ? previous->energy_
                  : energy_of(rest, *domain_, settings.roundness)),
      handles_(rest, *domain_, *energy_, {settings.pin_weight, settings.stretch_limit}),
      program_(std::make_unique<SheetProgram>(energy_, handles_.holds())) {}

SheetState SheetSolver::at_rest() const {
  const Points& z = domain_->mesh->vertices;
  return {Eigen::Map<const VectorXc>(z.data(), static_cast<Index>(z.size())),
          std::vector<double>(handles_.pins().size(), 0)};
}

/// Newton steps, in which no rotation can change by half a turn.
SheetProgram::Step SheetSolver::minimize(const SheetPull& pull, int most, SheetState& state,
                                         const std::stop_token& stop, bool is_near) const {
  constexpr double kTolerance = 1e-12;  // the last step is still taken
  const auto after = [&](const VectorXc& f) {
    throw_if_stopped(stop);
    for (size_t i = 0; i < state.turns.size(); ++i) {
      const size_t triangle = static_cast<size_t>(handles_.places()[i].triangle);
      double& turn = state.turns[i];
      turn += std::arg(energy_->strain(triangle, f).fz * std::polar(1.0, -turn));
    }
  };
  state.rests_at.clear();
  return program_->minimize(pull, state.f, most, after, kTolerance, is_near);
}

const ConformalPaths& SheetSolver::paths() const {
  std::call_once(paths_once_, [this] {
    paths_ = std::make_unique<const ConformalPaths>(domain_->mesh, handles_.moving_rows());
  });
  return *paths_;
}

SheetState SheetSolver::solved(const SheetHandles::Target& target,
                               const std::stop_token& stop) const {
  constexpr double kFar = 0.7, kNear = 1.5;  // radians
  const auto is_given = [](const auto& turn) { return turn.has_value(); };
  ConformalPaths::Path path = paths().path(target.displacements);
  std::vector<double> rotations;
  for (const Location& place : handles_.places())
    rotations.push_back(ConformalPaths::rotation(path, place.triangle));
  const int whole = handles_.whole_turns(target, rotations);
  path = ConformalPaths::turned(std::move(path), whole);
  // Frames turn what is around them on any path.
  SheetHandles::Target turned = target;
  bool agrees = true;
  for (size_t i = 0; i < rotations.size(); ++i) {
    rotations[i] += 2 * kPi * whole;
    const auto& turn = target.turns[i];
    agrees = agrees && std::abs(rotations[i] - turn.value_or(rotations[i])) < kNear;
    turned.turns[i] = turn.value_or(rotations[i]);
    rotations[i] = handles_.turn(i, target).value_or(rotations[i]);
  }
  const double largest =
      rotations.empty() ? path.end.logarithm.imag().cwiseAbs().maxCoeff() : turned.largest_turn();
  SheetState state;
  if (!agrees) {
    const ConformalPaths::Path wound = paths().wound(handles_.places(), rotations);
    state = reached(target, &wound, stop);
  } else if (largest < kFar) {
    state = reached(target, nullptr, stop);
  } else {
    state = reached(turned, &path, stop);
    if (std::ranges::none_of(target.turns, is_given)) {
      SheetState straight = reached(target, nullptr, stop);
      const auto cost = [&](const SheetState& at) {
        return program_->value(at.f, handles_.pull(target, at.turns));
      };
      if (cost(straight) < cost(state)) state = std::move(straight);
    }
  }
  if (settings_.exact) meet_within_reach(target, state);
  return state;
}

void SheetSolver::meet_within_reach(const SheetHandles::Target& target, SheetState& state) const {
  constexpr double kReached = 0.02, kMet = 1e-9;  // of the size
  const SheetPull pull = handles_.pull(target, state.turns);
  Places places(handles_.pins().size());
  for (size_t i = 0; i < places.size(); ++i)
    if (std::abs(handles_.image(i, state.f) - pull.rows[i].target) <= kReached * domain_->size)
      places[i] = pull.rows[i].target;
  meet(pull, places, kMet, state);
}

/// Follows a conformal path, or straight ways.
SheetState SheetSolver::reached(const SheetHandles::Target& target,
                                const ConformalPaths::Path* path,
                                const std::stop_token& stop) const {
  constexpr double kWay = 0.1, kTurn = 0.35;  // of a step, in units of the size and in radians
  constexpr double kMostSteps = 24;
  constexpr int kGentle = 4;
  SheetState state = at_rest();
  const auto step_to = [&](const Points& at, double part, double strength) {
    SheetPull pull = handles_.pull(target, at, part, state.turns);
    handles_.add_turns(target, part, strength, pull);
    minimize(pull, 1, state, stop);
  };
  const int steps =
      static_cast<int>(std::clamp(std::ceil(std::max(target.farthest() / (kWay * domain_->size),
                                                     target.largest_turn() / kTurn)),
                                  1.0, kMostSteps));
  for (int step = 1; step <= steps; ++step) {
    const double part = static_cast<double>(step) / steps;
    Points at = handles_.straight(target, part);
    if (path) {
      const VectorXc f = paths().at(*path, part);
      for (size_t row = 0; row < at.size(); ++row)
        at[row] = handles_.image(row, f) +
                  part * (handles_.wanted(row, target) - handles_.image(row, path->end.f));
    }
    step_to(at, part, 1);
  }
  // Let go of the turns gently, or the picture springs back farther than it has to.
  if (target.has_turns())
    for (const double strength : {0.1, 0.01, 0.001})
      for (int step = 0; step < kGentle; ++step) step_to(handles_.straight(target, 1), 1, strength);
  settle(target, state, stop);
  return state;
}

void SheetSolver::settle(const SheetHandles::Target& target, SheetState& state,
                         const std::stop_token& stop) const {
  constexpr int kMost = 100, kMostSteps = 200, kMostRounds = 3;
  constexpr double kStill = 1e-7;  // of the size
  for (int step = 0, rounds = 0; step < kMostSteps; ++step) {
    throw_if_stopped(stop);
    if (!handles_.is_behind(target, state.turns)) {
      minimize(handles_.pull(target, state.turns), kMost, state, stop);
      // A frame near its limit may fall behind again.
      if (!handles_.is_behind(target, state.turns) || ++rounds == kMostRounds) break;
    }
    const VectorXc before = state.f;
    state = followed(target, std::move(state));
    if ((state.f - before).cwiseAbs().maxCoeff() < kStill * domain_->size) break;
  }
}

SheetState SheetSolver::settled(const SheetHandles::Target& target, SheetState before,
                                const std::stop_token& stop) const {
  settle(target, before, stop);
  if (settings_.exact) meet_within_reach(target, before);
  return before;
}

/// Only where the targets have not moved, and a projected step has hardly lowered the energy, is a
/// step without projection tried. Frames that are behind move their targets.
SheetState SheetSolver::followed(const SheetHandles::Target& target, SheetState before) const {
  constexpr double kRests = 1e-5;  // of the value
  const SheetPull pull = handles_.pull(target, before.turns);
  Points targets;
  for (const SheetPull::Row& row : pull.rows) targets.push_back(row.target);
  const bool is_near = before.rests_at == targets;
  const SheetProgram::Step last = minimize(pull, 1, before, {}, is_near);
  if (last.length > 0.5 && last.decrement <= kRests * last.value)
    before.rests_at = std::move(targets);
  return before;
}

/// The method of multipliers: the targets of pins with places are moved on by what the pins miss.
void SheetSolver::meet(SheetPull pull, const Places& places, double within,
                       SheetState& state) const {
  constexpr int kRounds = 12, kSteps = 4;
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i]) pull.rows[i].spring = pull.rows[i].spring.firm();
  for (int round = 0; round < kRounds; ++round) {
    double missed = 0;
    for (size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      const Complex off = *places[i] - handles_.image(i, state.f);
      missed = std::max(missed, std::abs(off));
      pull.rows[i].target += off;
    }
    if (missed <= within * domain_->size) return;
    minimize(pull, kSteps, state);
  }
}

VectorXc SheetSolver::relaxed(const SheetPull& pull, const Places& places, VectorXc f) const {
  constexpr int kMost = 20;
  constexpr double kWithin = 1e-7;
  SheetState state{std::move(f), {}};
  minimize(pull, kMost, state);
  meet(pull, places, kWithin, state);
  return std::move(state.f);
}

VectorXc SheetSolver::missing_load(const SheetPull& pull, const VectorXc& f) const {
  const VectorXd gradient = program_->gradient(f, pull);
  VectorXc load(f.size());
  for (Index v = 0; v < load.size(); ++v) load[v] = {gradient[2 * v], gradient[2 * v + 1]};
  return load;
}

SmoothMap SheetSolver::smooth(const VectorXc& f) const {
  return {domain_->mesh, std::shared_ptr<const MeshLocator>(domain_, &domain_->locator), f,
          domain_->gradients.fz(f), domain_->gradients.fzbar(f)};
}

}  // namespace holomorph
