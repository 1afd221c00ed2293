// Method `sheet`: an elastic sheet that resists changes of size and shape, and bending. Pins act
// near where they are, because the energy is that of the picture's area and not of a space of
// harmonic maps.
#include <mutex>

#include "core/error.h"
#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/methods/sheet_motion.h"

namespace holomorph {
namespace {

class SheetDeformer final : public Deformer {
 public:
  SheetDeformer(const Rest& rest, const SheetDeformer* previous)
      : rest_(rest),
        solver_(std::make_shared<const SheetSolver>(rest_, settings_of(rest),
                                                    previous ? previous->solver_.get() : nullptr)) {
    for (const Complex& z : rest_.samples) places_.push_back(domain().locator.near(z));
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    const SheetHandles::Target target = handles().target(pose);
    const auto* before = dynamic_cast<const SheetSolution*>(from);
    const auto found = std::make_shared<SheetSolution>();
    found->solver = solver_;
    if (const auto rigid = handles().rigid(target)) {
      found->state = moved(*rigid, target);
      SampledMap out = rigid_map(*rigid, options);
      finish(found, out);
      return out;
    }
    if (options.draft && before && before->solver == solver_)
      found->state = solver_->followed(target, before->state);
    else
      found->state = solver_->solved(target, options.stop);
    ProvedSheet sheet(*solver_, found->state.f);
    SampledMap out = sheet.sampled(places_, options.derivatives);
    if (sheet.is_proved()) {
      if (!options.draft) out.extremes = sheet.extremes();
      out.note = "No folds" + missed_text(target, sheet.map(), out.extremes);
    } else {
      out.note = "Not proved near " + point_text(sheet.unproved());
    }
    finish(found, out);
    if (!options.draft && is_twisted(target, found->state, options.stop))
      out.note += ". Untwist would relax it";
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    const SheetHandles::Target target = handles().target(pose);
    const auto rigid = handles().rigid(target);
    return ProvedSheet(*solver_, rigid ? moved(*rigid, target).f : solver_->solved(target, {}).f)
        .released();
  }

  std::optional<double> usual_radius(size_t pin) const override {
    return handles().usual_radius(rest_.pins[pin].position);
  }

  std::shared_ptr<const ProvedMotion> motion() const override {
    std::call_once(motion_once_, [this] { motion_ = sheet_motion(solver_, places_); });
    return motion_;
  }

 private:
  static SheetSolver::Settings settings_of(const Rest& rest) {
    const Method& method = method_named("sheet");
    const auto value = [&](const char* key) { return parameter(method, rest.parameters, key); };
    return {value("roundness"), value("pin_weight"), value("exact") != 0};
  }
  const SheetDomain& domain() const { return solver_->domain(); }
  const SheetHandles& handles() const { return solver_->handles(); }

  /// A map that moves all of the picture, with whole turns that are as close as possible to the
  /// target's.
  SheetState moved(const Similarity& rigid, const SheetHandles::Target& target) const {
    SheetState state = solver_->at_rest();
    if (!is_identity(rigid))
      for (Complex& z : state.f) z = rigid(z);
    for (size_t i = 0; i < state.turns.size(); ++i) {
      const double wanted = target.turns[i].value_or(0), turn = std::arg(rigid.factor);
      state.turns[i] = turn + 2 * kPi * std::round((wanted - turn) / (2 * kPi));
    }
    return state;
  }
  SampledMap rigid_map(const Similarity& rigid, const EvalOptions& options) const {
    const Index count = static_cast<Index>(rest_.samples.size());
    SampledMap out;
    out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
    if (!is_identity(rigid))
      for (Complex& z : out.f) z = rigid(z);
    out.status = SampledMap::Status::certified;
    out.note = "No folds";
    if (!options.draft) out.extremes = Extremes{};
    if (!options.derivatives) return out;
    out.fz = VectorXc::Constant(count, rigid.factor);
    out.fzbar = VectorXc::Zero(count);
    return out;
  }

  std::string missed_text(const SheetHandles::Target& target, const SmoothMap& map,
                          const std::optional<Extremes>& extremes) const {
    Points offsets;
    for (size_t i = 0; i < handles().pins().size(); ++i)
      offsets.push_back(map.at(handles().places()[i]).f - handles().wanted(i, target));
    const std::string missed = missed_pins_text(handles().pins(), offsets, kMissed * domain().size);
    return missed.empty() ? missed : missed + strain_text(extremes);
  }

  /// Whether the map that the turns lead to costs much more than the map without them.
  bool is_twisted(SheetHandles::Target target, const SheetState& state,
                  const std::stop_token& stop) const {
    constexpr double kStrained = 4, kClearly = 0.7;  // energies; 2 is rigid
    const double energy = solver_->energy().value(state.f);
    if (energy < kStrained || !target.has_turns()) return false;
    for (auto& turn : target.turns) turn.reset();
    return solver_->energy().value(solver_->solved(target, stop).f) < kClearly * energy;
  }

  void finish(const std::shared_ptr<SheetSolution>& found, SampledMap& out) const {
    out.turns.resize(rest_.pins.size());
    for (size_t i = 0; i < handles().pins().size(); ++i)
      out.turns[handles().pins()[i]] = found->state.turns[i];
    if (!handles().note().empty()) out.note += ". " + handles().note();
    out.solution = found;
  }

  Rest rest_;
  std::shared_ptr<const SheetSolver> solver_;
  std::vector<Location> places_;  ///< of the samples
  mutable std::once_flag motion_once_;
  mutable std::shared_ptr<const ProvedMotion> motion_;
};

std::unique_ptr<Deformer> make_sheet(const Rest& rest, const Deformer* previous) {
  return std::make_unique<SheetDeformer>(rest, dynamic_cast<const SheetDeformer*>(previous));
}

}  // namespace

Method sheet_method() {
  return {
      .id = "sheet",
      .label = "Puppet",
      .summary = "Bends where you pull. Sizes stay.",
      .hint =
          "Pins move what is near them, and what is far away stays. Sizes and shapes are kept as "
          "far as possible, and nothing folds. Paint stiffness (B) on parts that should change "
          "least. Without pins, the cage points stay where you put them.",
      .parameters =
          {number("roundness", "Roundness",
                  "Higher values spread a bend over more of a limb; at 0, pins pull out spikes",
                  1.5, 0, 4),
           toggle("exact", "Exact pins", "Meet the pins exactly when the pointer is released"),
           by_decades("pin_weight", "Pin weight", "Higher values meet the pins more closely", 1e5,
                      1e2, 1e7)},
      .uses_pins = true,
      .uses_strokes = true,
      .uses_stiffness = true,
      .uses_frame = true,
      .holds_disks = true,
      .pins_replace_cage = true,
      .limbs_in_front = true,
      .never_folds = true,
      .iterates = true,
      .harmonic = false,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .smooths_mesh = true,
      .make = make_sheet,
  };
}

}  // namespace holomorph
