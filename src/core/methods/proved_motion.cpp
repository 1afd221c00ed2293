#include "core/methods/proved_motion.h"

#include <algorithm>

#include "core/maps/distortion.h"
#include "core/maps/still_pins.h"
#include "core/methods/bounded_points.h"
#include "core/methods/notes.h"

namespace holomorph {
namespace {

/// The key before an interval, its ends, and the key after it; some may be null.
using Keys = std::array<std::unique_ptr<LogKey>, 4>;

/// A map between keys, with the keys that it refers to.
struct BlendedSolution final : Solution {
  BlendedSolution(LogSum found, std::shared_ptr<const Keys> of)
      : map(std::move(found)), keys(std::move(of)) {}
  LogSum map;
  std::shared_ptr<const Keys> keys;
};

/// What is shared by all intervals of a deformer.
struct Shared {
  explicit Shared(MotionSetting own)
      : setting(std::move(own)), between(setting.basis, setting.mesh, setting.positions) {}
  MotionSetting setting;
  LogInbetween between;
};

class ProvedInterval final : public MotionInterval {
 public:
  /// `reason` says why pins slide, if any do.
  ProvedInterval(std::shared_ptr<const Shared> shared, std::shared_ptr<const Keys> keys,
                 LogInterval interval, SlideReason reason)
      : shared_(std::move(shared)),
        keys_(std::move(keys)),
        interval_(std::move(interval)),
        reason_(reason) {}

  SampledMap at(double u, bool measures) const override {
    LogInterval::Blend blend = interval_.at(u, measures);
    SampledMap map;
    map.f = std::move(blend.f);
    map.fz = std::move(blend.first.phi);
    map.fzbar = blend.first.psi.conjugate();
    map.extremes = blend.extremes;
    map.solution = std::make_shared<BlendedSolution>(std::move(blend.map), keys_);
    const int flipped = flipped_triangles(*shared_->setting.mesh, map.f);
    if (blend.certified) map.coarse_triangles = flipped;
    map.status = blend.certified && flipped == 0 ? SampledMap::Status::certified
                                                 : SampledMap::Status::infeasible;
    map.note = !blend.certified ? "Between keyframes: not proved"
               : flipped > 0    ? coarse_mesh_text(flipped)
                                : kNoFoldsBetween;
    if (!blend.certified) return map;
    std::vector<SlidingPin> pins;
    for (const auto& [station, distance] : blend.slides)
      pins.push_back({shared_->setting.pins[static_cast<size_t>(station)], distance});
    map.note += sliding_pins_text(pins, reason_);
    return map;
  }

 private:
  std::shared_ptr<const Shared> shared_;
  std::shared_ptr<const Keys> keys_;
  LogInterval interval_;
  SlideReason reason_;
};

class LogMotion final : public ProvedMotion {
 public:
  explicit LogMotion(MotionSetting setting)
      : shared_(std::make_shared<const Shared>(std::move(setting))) {}

  std::unique_ptr<MotionInterval> interval(const MotionKey* before, const MotionKey& from,
                                           const MotionKey& to, const MotionKey* after,
                                           bool smooth) const override {
    Keys keys{key_of(before), key_of(&from), key_of(&to), key_of(after)};
    if (!keys[1] || !keys[2]) return nullptr;
    std::vector<char> held;
    for (const size_t i : shared_->setting.pins)
      held.push_back(from.pose->pins[i].position == to.pose->pins[i].position);
    const LogInbetween& between = shared_->between;
    const bool turns = makes_whole_turns(to.asked, rotation_at_held(keys, held));
    if (!turns) turn_with_still_pins(keys, held);
    LogInterval own = between.interval({keys[0].get(), keys[1].get(), keys[2].get(), keys[3].get()},
                                       smooth, held, turns ? 1 : held.size());
    return std::make_unique<ProvedInterval>(shared_, std::make_shared<const Keys>(std::move(keys)),
                                            std::move(own),
                                            turns ? SlideReason::whole_turns : SlideReason::limits);
  }

  std::unique_ptr<PointMap> point_map(const SampledMap& between) const override {
    const auto* found = dynamic_cast<const BlendedSolution*>(between.solution.get());
    if (!found) return nullptr;
    const auto at = [map = found->map, keys = found->keys](const MatrixXc& c) { return map.at(c); };
    return std::make_unique<BoundedPointMap>(shared_->setting.basis, shared_->setting.mesh, at,
                                             between.f);
  }

 private:
  /// Adds a whole turn to the second half of the motion if pins that both ends hold slide much less
  /// then. The rotation of the picture at one of them does not always tell.
  void turn_with_still_pins(Keys& keys, const std::vector<char>& held) const {
    if (std::ranges::count(held, char{1}) < 2) return;
    const auto turned = [](LogKey key, int turns) {
      key.map.l.array() += 2 * kPi * turns * kI;
      return key;
    };
    int best = 0;
    constexpr double kClearly = 0.5;
    double least = kClearly * shared_->between.slide(*keys[1], *keys[2], held);
    for (const int turns : {-1, 1})
      if (const double slide = shared_->between.slide(*keys[1], turned(*keys[2], turns), held);
          slide < least)
        least = slide, best = turns;
    if (best == 0) return;
    for (const size_t k : {size_t{2}, size_t{3}})
      if (keys[k]) *keys[k] = turned(std::move(*keys[k]), best);
  }

  /// By how much the picture turns where the first held pin is; 0 if there is none.
  double rotation_at_held(const Keys& keys, const std::vector<char>& held) const {
    const auto first = static_cast<size_t>(std::ranges::find(held, char{1}) - held.begin());
    if (first == held.size()) return 0;
    return shared_->between.argument_at(keys[2]->map, first) -
           shared_->between.argument_at(keys[1]->map, first);
  }

  /// Null if the key is not certified.
  std::unique_ptr<LogKey> key_of(const MotionKey* key) const {
    if (!key || !key->extremes || !key->solution) return nullptr;
    const LogMap* map = shared_->setting.map_of(*key->solution);
    if (!map) return nullptr;
    auto own = std::make_unique<LogKey>(LogKey{*map, *key->extremes, *key->f, key->time});
    const double turns =
        std::round((key->rotation - shared_->between.mean_argument(own->map)) / (2 * kPi));
    own->map.l.array() += 2 * kPi * turns * kI;
    return own;
  }

  std::shared_ptr<const Shared> shared_;
};

}  // namespace

std::shared_ptr<const ProvedMotion> proved_motion(MotionSetting setting) {
  return std::make_shared<const LogMotion>(std::move(setting));
}

}  // namespace holomorph
