#include "core/methods/sheet_part.h"

#include <cmath>

#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/sheet_motion.h"
#include "core/methods/sheet_release.h"

namespace holomorph {
namespace {

SheetSolver::Settings settings_of(const Rest& rest) {
  const Method& method = method_named("sheet");
  const auto value = [&](const char* key) { return parameter(method, rest.parameters, key); };
  return {value("roundness"), value("pin_weight"), value("stretch_limit"), value("exact") != 0};
}

}  // namespace

SheetPart::SheetPart(const Rest& rest, std::vector<size_t> numbers, const Points& anchors,
                     const SheetPart* previous)
    : samples_(rest.samples),
      anchor_points_(anchors),
      numbers_(std::move(numbers)),
      solver_(std::make_shared<const SheetSolver>(rest, settings_of(rest),
                                                  previous ? previous->solver_.get() : nullptr)) {
  for (const Complex& z : samples_) places_.push_back(domain().locator.near(z));
  for (const Complex& z : anchors) anchors_.push_back(domain().locator.near(z));
}

SheetPart::Found SheetPart::deform(const Pose& pose, const EvalOptions& options,
                                   const Solution* from) const {
  SheetHandles::Target target = handles().target(pose);
  const auto* before = dynamic_cast<const SheetSolution*>(from);
  const auto solution = std::make_shared<SheetSolution>();
  solution->solver = solver_;
  Found found;
  std::optional<ReleasedSheet> better;
  if (const auto rigid = handles().rigid(target)) {
    solution->state = moved(*rigid, target);
    found.map = rigid_map(*rigid, options);
    for (const Complex& z : anchor_points_)
      found.anchors.push_back({(*rigid)(z), rigid->factor, 0});
  } else {
    if (before && before->solver != solver_) before = nullptr;
    solution->state = options.draft && before ? solver_->followed(target, before->state)
                                              : solver_->solved(target, options.stop);
    if (options.released && before)
      better = released_sheet(*solver_, target, before->state, solution->state, options.stop);
    if (better) {
      solution->state = better->state;
      target.turns = better->turns;
    }
    ProvedSheet sheet(*solver_, solution->state.f);
    found.map = sheet.sampled(places_, options.derivatives);
    for (const Location& at : anchors_) found.anchors.push_back(sheet.map().at(at));
    if (sheet.is_proved()) {
      if (!options.draft) found.map.extremes = sheet.extremes();
      found.missed = missed_text(target, sheet.map(), found.map.extremes);
    } else {
      found.unproved = sheet.unproved();
    }
    found.twisted = !options.draft && is_twisted(target, solution->state, options.stop);
  }
  const std::vector<size_t>& pins = handles().pins();
  found.map.turns.resize(numbers_.size());
  for (size_t i = 0; i < pins.size(); ++i) found.map.turns[pins[i]] = solution->state.turns[i];
  if (better) {
    for (const PosePin& pin : pose.pins) found.map.better_turns.push_back(pin.turn);
    for (size_t i = 0; i < pins.size(); ++i)
      if (!handles().is_framed(i)) found.map.better_turns[pins[i]] = better->turns[i];
  }
  found.solution = solution;
  return found;
}

std::unique_ptr<PointMap> SheetPart::point_map(const Pose& pose) const {
  const SheetHandles::Target target = handles().target(pose);
  const auto rigid = handles().rigid(target);
  return ProvedSheet(*solver_, rigid ? moved(*rigid, target).f : solver_->solved(target, {}).f)
      .released();
}

std::shared_ptr<const ProvedMotion> SheetPart::motion() const {
  std::vector<Location> places = places_;
  places.insert(places.end(), anchors_.begin(), anchors_.end());
  std::vector<size_t> numbers;
  for (const size_t pin : handles().pins()) numbers.push_back(numbers_[pin]);
  return sheet_motion(solver_, std::move(places), std::move(numbers));
}

/// A map that moves all of the part. All pins have the same turn.
SheetState SheetPart::moved(const Similarity& rigid, const SheetHandles::Target& target) const {
  SheetState state = solver_->at_rest();
  if (!is_identity(rigid))
    for (Complex& z : state.f) z = rigid(z);
  const double turn = std::arg(rigid.factor);
  state.turns.assign(state.turns.size(), turn);
  const int whole = handles().whole_turns(target, state.turns);
  for (double& each : state.turns) each += 2 * kPi * whole;
  return state;
}

SampledMap SheetPart::rigid_map(const Similarity& rigid, const EvalOptions& options) const {
  const Index count = static_cast<Index>(samples_.size());
  SampledMap out;
  out.f = Eigen::Map<const VectorXc>(samples_.data(), count);
  if (!is_identity(rigid))
    for (Complex& z : out.f) z = rigid(z);
  out.status = SampledMap::Status::certified;
  if (!options.draft) out.extremes = Extremes{};
  if (!options.derivatives) return out;
  out.fz = VectorXc::Constant(count, rigid.factor);
  out.fzbar = VectorXc::Zero(count);
  return out;
}

std::string SheetPart::missed_text(const SheetHandles::Target& target, const SmoothMap& map,
                                   const std::optional<Extremes>& extremes) const {
  Points offsets;
  std::vector<size_t> pins;
  bool limited = false;
  const double least = kMissed * domain().size;
  for (size_t i = 0; i < handles().pins().size(); ++i) {
    offsets.push_back(map.at(handles().places()[i]).f - handles().wanted(i, target));
    pins.push_back(numbers_[handles().pins()[i]]);
    const double missed = std::abs(offsets.back());
    limited = limited || (missed >= least && handles().gives_way(i, target, missed));
  }
  const std::string missed = missed_pins_text(pins, offsets, least);
  if (missed.empty()) return missed;
  return missed + (limited ? ", at the stretch limit" : strain_text(extremes));
}

/// Whether the map that the turns lead to costs much more than the map without them.
bool SheetPart::is_twisted(SheetHandles::Target target, const SheetState& state,
                           const std::stop_token& stop) const {
  constexpr double kStrained = 4, kClearly = 0.7;  // energies; 2 is rigid
  const double energy = solver_->energy().value(state.f);
  if (energy < kStrained || !target.has_turns()) return false;
  for (auto& turn : target.turns) turn.reset();
  return solver_->energy().value(solver_->solved(target, stop).f) < kClearly * energy;
}

}  // namespace holomorph
