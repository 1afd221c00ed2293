// At a key, the forces of the handles balance those of the sheet. In between, handles pull at the
// images that the blended map gives them with blended forces, so that motion begins and ends at the
// maps of the keys.
#include "core/methods/sheet_motion.h"

#include <cmath>

#include "core/arithmetic.h"
#include "core/maps/distortion.h"
#include "core/mesh/inbetween.h"
#include "core/sheet/fixed_coordinates.h"

namespace holomorph {
namespace {

/// What is shared by all intervals of a deformer.
struct SheetSetting {
  std::shared_ptr<const SheetSolver> solver;
  std::vector<Location> places;
  std::shared_ptr<const Inbetween> between;
  std::shared_ptr<const FixedCoordinates> frame;
};

struct SheetKey {
  Inbetween::Shape shape;
  SheetPull pull;
  double time = 0;
};

class SheetInterval final : public MotionInterval {
 public:
  SheetInterval(std::shared_ptr<const SheetSetting> setting,
                std::array<std::optional<SheetKey>, 4> keys, bool smooth, std::vector<char> met)
      : setting_(std::move(setting)),
        keys_(std::move(keys)),
        still_(least_moving_point(mesh(), keys_[1]->shape.f, keys_[2]->shape.f)),
        met_(std::move(met)),
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
    const SheetPull pull = blended_pull(u, f);
    if (flipped_triangles(mesh(), f) > 0) f = (u < 0.5 ? keys_[1] : keys_[2])->shape.f;
    const ProvedSheet sheet(solver(), solver().relaxed(pull, met_, std::move(f)));
    SampledMap map = sheet.sampled(setting_->places, true);
    if (sheet.is_proved() && measures) map.extremes = sheet.extremes();
    map.note = sheet.is_proved() ? "Between keyframes: no folds" : "Between keyframes: not proved";
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

  SheetPull blended_pull(double u, const VectorXc& f) const {
    const SheetKey &from = *keys_[1], &to = *keys_[2];
    const double share = smooth_ ? smoothstep(u) : u;
    const auto force = [](const Spring& spring, Complex off) {
      return spring.slope(std::norm(off)) * off;
    };
    SheetPull pull = from.pull;
    for (size_t row = 0; row < pull.rows.size(); ++row) {
      auto& [target, spring] = pull.rows[row];
      if (row < met_.size() && met_[row] != 0 && target == to.pull.rows[row].target) {
        // Each key may miss the target by a different amount: the pin moves straight.
        target = (1 - share) * solver().handles().image(row, from.shape.f) +
                 share * solver().handles().image(row, to.shape.f);
        continue;
      }
      const auto at = [&](const SheetKey& key) {
        const SheetPull::Row& there = key.pull.rows[row];
        return force(there.spring, there.target - solver().handles().image(row, key.shape.f));
      };
      spring = spring.firm();
      target = solver().handles().image(row, f) + ((1 - u) * at(from) + u * at(to)) / spring.weight;
    }
    return pull;
  }

  std::shared_ptr<const SheetSetting> setting_;
  std::array<std::optional<SheetKey>, 4> keys_;
  std::array<std::optional<VectorXc>, 2> slopes_;
  Location still_;
  std::vector<char> met_;  ///< for each pin, whether it has an exact place in between
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
    std::vector<char> met;
    const SheetSolver& solver = *setting_->solver;
    bool any = false;
    for (size_t i = 0; i < solver.handles().pins().size(); ++i) {
      // A picture that makes whole turns cannot hold two pins.
      met.push_back(is_met(*keys[1], *keys[2], i) && !(any && to.turns != 0));
      any = any || met.back() != 0;
    }
    return std::make_unique<SheetInterval>(setting_, std::move(keys), smooth, std::move(met));
  }

 private:
  /// Whether a pin has one target, which it may miss, or meets its targets exactly.
  bool is_met(const SheetKey& from, const SheetKey& to, size_t pin) const {
    constexpr double kMet = 1e-3;  // of the size
    const SheetSolver& solver = *setting_->solver;
    const auto is_at = [&](const SheetKey& key, Complex target) {
      const Complex image = solver.handles().image(pin, key.shape.f);
      return std::abs(image - target) <= kMet * solver.domain().size;
    };
    const Complex first = from.pull.rows[pin].target, last = to.pull.rows[pin].target;
    return first == last || (solver.settings().exact && is_at(from, first) && is_at(to, last));
  }
  /// None if the key is not certified.
  std::optional<SheetKey> key_of(const MotionKey* key) const {
    if (!key || !key->extremes) return {};
    const SheetSolver& solver = *setting_->solver;
    const auto* found = dynamic_cast<const SheetSolution*>(key->solution.get());
    if (!found || found->solver != setting_->solver) return {};
    Inbetween::Shape shape = setting_->between->shape_of(found->state.f, 0);
    const double turns = std::round((key->rotation - shape.logarithm.imag().mean()) / (2 * kPi));
    if (turns != 0) shape = setting_->between->shape_of(found->state.f, static_cast<int>(turns));
    return SheetKey{std::move(shape),
                    solver.handles().pull(solver.handles().target(*key->pose), found->state.turns),
                    key->time};
  }

  std::shared_ptr<const SheetSetting> setting_;
};

}  // namespace

std::shared_ptr<const ProvedMotion> sheet_motion(std::shared_ptr<const SheetSolver> solver,
                                                 std::vector<Location> places) {
  const std::shared_ptr<const Mesh>& mesh = solver->domain().mesh;
  auto between = std::make_shared<const Inbetween>(mesh);
  auto frame = std::make_shared<const FixedCoordinates>(mesh, solver->handles().holds().fixed);
  return std::make_shared<const SheetMotion>(
      SheetSetting{solver, std::move(places), std::move(between), std::move(frame)});
}

}  // namespace holomorph
