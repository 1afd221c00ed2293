// At a key, the forces of the handles almost balance those of the sheet: exact pins are held by
// shifted targets, which the springs do not contain, and the solver may have stopped early. A load
// adds what is missing. In between, handles pull at
// the images that the blended map gives them with blended forces, and the loads are blended, so
// that motion begins and ends at the maps of the keys.
#include "core/methods/sheet_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/arithmetic.h"
#include "core/maps/distortion.h"
#include "core/maps/still_pins.h"
#include "core/mesh/inbetween.h"
#include "core/methods/notes.h"
#include "core/sheet/fixed_coordinates.h"

namespace holomorph {
namespace {

/// What is shared by all intervals of a deformer.
struct SheetSetting {
  std::shared_ptr<const SheetSolver> solver;
  std::vector<Location> places;
  std::vector<size_t> numbers;  ///< of the pins
  std::shared_ptr<const Inbetween> between;
  std::shared_ptr<const FixedCoordinates> frame;
  VectorXd tethers;  ///< weights with which vertices are pulled to the blended map
};

/// Weak springs from each vertex to its place in a blended map. A compressed limb buckles to one
/// side or to the other, and a small change of the blended map could make it jump from one to the
/// other. The springs decide, and hardly change sizes.
VectorXd tethers_of(const SheetDomain& domain) {
  constexpr double kWeight = 100;  // of all springs together; a pin has 1e5
  VectorXd areas = VectorXd::Zero(static_cast<Index>(domain.mesh->vertices.size()));
  for (const Triangle& t : domain.mesh->triangles)
    for (const int v : t) areas[v] += area_of(*domain.mesh, t);
  return kWeight / (domain.size * domain.size) / areas.sum() * areas;
}

struct SheetKey {
  Inbetween::Shape shape;
  double time = 0;
  SheetPull pull = {};
  Points pins = {};  ///< their images
};

/// A map between keys, at the vertices of the solver's mesh.
struct BlendedSheet final : Solution {
  explicit BlendedSheet(VectorXc found) : f(std::move(found)) {}
  VectorXc f;
};

/// What both ends of an interval do with a pin.
enum class Held : char {
  no,
  still,   ///< both hold it at one target
  slides,  ///< the same, but a picture that makes whole turns can hold only one pin
  follows  ///< both meet its targets exactly: it is held where the blended map puts it
};

class SheetInterval final : public MotionInterval {
 public:
  SheetInterval(std::shared_ptr<const SheetSetting> setting,
                std::array<std::optional<SheetKey>, 4> keys, bool smooth, std::vector<Held> held)
      : setting_(std::move(setting)),
        keys_(std::move(keys)),
        held_(std::move(held)),
        still_(still_point()),
        smooth_(smooth) {
    if (!smooth) return;
    slopes_[0] = slopes(keys_[0], *keys_[1], keys_[2]);
    slopes_[1] = slopes(keys_[1], *keys_[2], keys_[3]);
  }

  SampledMap at(double u, bool measures) const override {
    const Inbetween::Interval interval{keys_[1]->shape,
                                       keys_[2]->shape,
                                       keys_[2]->time - keys_[1]->time,
                                       slopes_[0] ? &*slopes_[0] : nullptr,
                                       slopes_[1] ? &*slopes_[1] : nullptr,
                                       &still_};
    VectorXc f;
    setting_->between->blend(interval, u, f);
    setting_->frame->restore(f);
    bool folds = flipped_triangles(mesh(), f) > 0;
    if (VectorXc unfolded = f; folds && setting_->between->unfold(unfolded)) {
      setting_->frame->restore(unfolded);
      folds = flipped_triangles(mesh(), unfolded) > 0;
      if (!folds) f = std::move(unfolded);
    }
    Blended at = blended(u, f);
    if (folds) {
      f = (u < 0.5 ? keys_[1] : keys_[2])->shape.f;
    } else {
      for (Index v = 0; v < f.size(); ++v)
        at.pull.vertices.push_back({static_cast<int>(v), f[v], {setting_->tethers[v]}});
    }
    const auto found =
        std::make_shared<const BlendedSheet>(solver().relaxed(at.pull, at.places, std::move(f)));
    const ProvedSheet sheet(solver(), found->f);
    SampledMap map = sheet.sampled(setting_->places, true);
    map.solution = found;
    if (sheet.is_proved() && measures) map.extremes = sheet.extremes();
    map.note = sheet.is_proved() ? kNoFoldsBetween + sliding_text(u, sheet.map())
                                 : "Between keyframes: not proved";
    return map;
  }

 private:
  const SheetSolver& solver() const { return *setting_->solver; }
  const Mesh& mesh() const { return *solver().domain().mesh; }

  VectorXc slopes(const std::optional<SheetKey>& before, const SheetKey& here,
                  const std::optional<SheetKey>& after) const {
    return setting_->between->slopes(
        before ? &before->shape : nullptr, here.shape, after ? &after->shape : nullptr,
        before ? here.time - before->time : 0, after ? after->time - here.time : 0);
  }

  /// The first still pin. Pins that slide are then pulled to where the picture turns around it.
  Location still_point() const {
    for (size_t i = 0; i < held_.size(); ++i)
      if (held_[i] == Held::still) return solver().handles().places()[i];
    return least_moving_point(mesh(), keys_[1]->shape.f, keys_[2]->shape.f);
  }

  double share(double u) const { return smooth_ ? smoothstep(u) : u; }

  /// Tells which pins leave the straight path between their images at the ends, if both hold them.
  std::string sliding_text(double u, const SmoothMap& map) const {
    std::vector<SlidingPin> sliding;
    for (size_t i = 0; i < held_.size(); ++i) {
      if (held_[i] != Held::still && held_[i] != Held::slides) continue;
      const Complex straight = (1 - share(u)) * keys_[1]->pins[i] + share(u) * keys_[2]->pins[i];
      const double off = std::abs(map.at(solver().handles().places()[i]).f - straight);
      if (off > kStillPin * solver().domain().size) sliding.push_back({setting_->numbers[i], off});
    }
    const bool turns = std::ranges::find(held_, Held::slides) != held_.end();
    return sliding_pins_text(sliding, turns ? SlideReason::whole_turns : SlideReason::folds);
  }

  struct Blended {
    SheetPull pull;
    SheetSolver::Places places;
  };
  Blended blended(double u, const VectorXc& f) const {
    const SheetKey &from = *keys_[1], &to = *keys_[2];
    const auto force_at = [&](const SheetKey& key, size_t row) {
      const auto& [target, spring] = key.pull.rows[row];
      const Complex off = target - solver().handles().image(row, key.shape.f);
      return spring.slope(std::norm(off)) * off;
    };
    Blended all{from.pull, SheetSolver::Places(held_.size())};
    for (size_t row = 0; row < all.pull.rows.size(); ++row) {
      auto& [target, spring] = all.pull.rows[row];
      spring = spring.firm();
      const Held held = row < held_.size() ? held_[row] : Held::no;
      Complex place = solver().handles().image(row, f);
      // Each key may miss the target by a different amount: the pin moves straight.
      if (held == Held::still)
        place = (1 - share(u)) * solver().handles().image(row, from.shape.f) +
                share(u) * solver().handles().image(row, to.shape.f);
      target = place + ((1 - u) * force_at(from, row) + u * force_at(to, row)) / spring.weight;
      if (held == Held::still || held == Held::follows) all.places[row] = place;
    }
    all.pull.load = (1 - u) * from.pull.load + u * to.pull.load;
    return all;
  }

  std::shared_ptr<const SheetSetting> setting_;
  std::array<std::optional<SheetKey>, 4> keys_;
  std::array<std::optional<VectorXc>, 2> slopes_;
  std::vector<Held> held_;  ///< one for each pin
  Location still_;          ///< where the blended map moves straight
  bool smooth_;
};

class SheetMotion final : public ProvedMotion {
 public:
  explicit SheetMotion(SheetSetting setting)
      : setting_(std::make_shared<const SheetSetting>(std::move(setting))) {}

  std::unique_ptr<MotionInterval> interval(const MotionKey* before, const MotionKey& from,
                                           const MotionKey& to, const MotionKey* after,
                                           bool smooth) const override {
    std::array<std::optional<SheetKey>, 4> keys{key_of(before), key_of(&from), key_of(&to),
                                                key_of(after)};
    if (!keys[1] || !keys[2]) return nullptr;
    add_pull(from, *keys[1]);
    add_pull(to, *keys[2]);
    std::vector<Held> held;
    for (size_t i = 0; i < setting_->solver->handles().pins().size(); ++i)
      held.push_back(held_by(*keys[1], *keys[2], i));
    if (makes_whole_turns(to.asked, rotation_at(held, keys[1]->shape, keys[2]->shape)))
      hold_one(held);
    return std::make_unique<SheetInterval>(setting_, std::move(keys), smooth, std::move(held));
  }

  std::unique_ptr<PointMap> point_map(const SampledMap& between) const override {
    const auto* found = dynamic_cast<const BlendedSheet*>(between.solution.get());
    return found ? ProvedSheet(*setting_->solver, found->f).released() : nullptr;
  }

 private:
  /// How far the picture turns at the first still pin; 0 if there is none.
  double rotation_at(const std::vector<Held>& held, const Inbetween::Shape& from,
                     const Inbetween::Shape& to) const {
    const auto first = std::ranges::find(held, Held::still);
    if (first == held.end()) return 0;
    const auto pin = static_cast<size_t>(first - held.begin());
    const Index t = setting_->solver->handles().places()[pin].triangle;
    return (to.logarithm[t] - from.logarithm[t]).imag();
  }
  /// Lets all still pins but the first one slide.
  static void hold_one(std::vector<Held>& held) {
    bool holds = false;
    for (Held& pin : held)
      if (pin == Held::still && std::exchange(holds, true)) pin = Held::slides;
  }
  /// What both keys do with a pin. It may miss its only target.
  Held held_by(const SheetKey& from, const SheetKey& to, size_t pin) const {
    constexpr double kMet = 1e-3;  // of the size
    const SheetSolver& solver = *setting_->solver;
    const auto is_at = [&](const SheetKey& key, Complex target) {
      const Complex image = solver.handles().image(pin, key.shape.f);
      return std::abs(image - target) <= kMet * solver.domain().size;
    };
    const Complex first = from.pull.rows[pin].target, last = to.pull.rows[pin].target;
    if (first == last) return Held::still;
    const bool meets = solver.settings().exact && is_at(from, first) && is_at(to, last);
    return meets ? Held::follows : Held::no;
  }
  /// None if the key is not certified.
  std::optional<SheetKey> key_of(const MotionKey* key) const {
    if (!key || !key->extremes) return {};
    const auto* found = dynamic_cast<const SheetSolution*>(key->solution.get());
    if (!found || found->solver != setting_->solver) return {};
    Inbetween::Shape shape = setting_->between->shape_of(found->state.f, 0);
    const double turns = std::round((key->rotation - shape.logarithm.imag().mean()) / (2 * kPi));
    if (turns != 0) shape = setting_->between->shape_of(found->state.f, static_cast<int>(turns));
    return SheetKey{std::move(shape), key->time};
  }
  /// Adds how the handles of a key pull, and where its pins are.
  void add_pull(const MotionKey& key, SheetKey& own) const {
    const SheetSolver& solver = *setting_->solver;
    const auto& state = dynamic_cast<const SheetSolution&>(*key.solution).state;
    own.pull = solver.handles().pull(solver.handles().target(*key.pose), state.turns);
    own.pull.load = solver.missing_load(own.pull, state.f);
    const ProvedSheet sheet(solver, state.f);
    for (const Location& at : solver.handles().places()) own.pins.push_back(sheet.map().at(at).f);
  }

  std::shared_ptr<const SheetSetting> setting_;
};

}  // namespace

std::shared_ptr<const ProvedMotion> sheet_motion(std::shared_ptr<const SheetSolver> solver,
                                                 std::vector<Location> places,
                                                 std::vector<size_t> numbers) {
  const std::shared_ptr<const Mesh>& mesh = solver->domain().mesh;
  auto between = std::make_shared<const Inbetween>(mesh);
  auto frame = std::make_shared<const FixedCoordinates>(mesh, solver->handles().holds().fixed);
  return std::make_shared<const SheetMotion>(
      SheetSetting{solver, std::move(places), std::move(numbers), std::move(between),
                   std::move(frame), tethers_of(solver->domain())});
}

}  // namespace holomorph
