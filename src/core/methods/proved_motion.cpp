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

class ProvedInterval final : public MotionInterval {
 public:
  ProvedInterval(std::shared_ptr<const LogInbetween> between, const MotionSetting& setting,
                 Keys keys, bool smooth, const std::vector<char>& held, bool turns)
      : between_(std::move(between)),
        mesh_(setting.mesh),
        pins_(setting.pins),
        keys_(std::make_shared<const Keys>(std::move(keys))),
        turns_(turns),
        interval_(between_->interval((*keys_)[0].get(), *(*keys_)[1], *(*keys_)[2],
                                     (*keys_)[3].get(), smooth, held, turns ? 1 : held.size())) {}

  SampledMap at(double u, bool measures) const override {
    LogInterval::Blend blend = interval_.at(u, measures);
    SampledMap map;
    map.f = std::move(blend.f);
    map.fz = std::move(blend.first.phi);
    map.fzbar = blend.first.psi.conjugate();
    map.extremes = blend.extremes;
    map.solution = std::make_shared<BlendedSolution>(std::move(blend.map), keys_);
    const int flipped = flipped_triangles(*mesh_, map.f);
    map.status = blend.certified && flipped == 0 ? SampledMap::Status::certified
                                                 : SampledMap::Status::infeasible;
    map.note = !blend.certified ? "Between keyframes: not proved"
               : flipped > 0    ? coarse_mesh_text(flipped)
                                : kNoFoldsBetween;
    if (blend.certified && blend.slide)
      map.note += sliding_pin_text(pins_[static_cast<size_t>(blend.slide->station)],
                                   blend.slide->distance,
                                   turns_ ? SlideReason::whole_turns : SlideReason::limits);
    return map;
  }

 private:
  std::shared_ptr<const LogInbetween> between_;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<size_t> pins_;
  std::shared_ptr<const Keys> keys_;
  bool turns_;  ///< the picture makes whole turns, and so can hold only one pin
  LogInterval interval_;
};

class LogMotion final : public ProvedMotion {
 public:
  explicit LogMotion(MotionSetting setting)
      : setting_(std::move(setting)),
        between_(std::make_shared<const LogInbetween>(setting_.basis, setting_.mesh,
                                                      setting_.positions)) {}

  std::unique_ptr<MotionInterval> interval(const MotionKey* before, const MotionKey& from,
                                           const MotionKey& to, const MotionKey* after,
                                           bool smooth) const override {
    Keys keys{key_of(before), key_of(&from), key_of(&to), key_of(after)};
    if (!keys[1] || !keys[2]) return nullptr;
    std::vector<char> held;
    for (const size_t i : setting_.pins)
      held.push_back(from.pose->pins[i].position == to.pose->pins[i].position);
    const bool turns = makes_whole_turns(between_->mean_argument(keys[2]->map, held) -
                                         between_->mean_argument(keys[1]->map, held));
    return std::make_unique<ProvedInterval>(between_, setting_, std::move(keys), smooth, held,
                                            turns);
  }

  std::unique_ptr<PointMap> point_map(const SampledMap& between) const override {
    const auto* found = dynamic_cast<const BlendedSolution*>(between.solution.get());
    if (!found) return nullptr;
    const auto at = [map = found->map, keys = found->keys](const MatrixXc& c) { return map.at(c); };
    return std::make_unique<BoundedPointMap>(setting_.basis, setting_.mesh, at, between.f);
  }

 private:
  /// Null if the key is not certified.
  std::unique_ptr<LogKey> key_of(const MotionKey* key) const {
    if (!key || !key->extremes || !key->solution) return nullptr;
    const LogMap* map = setting_.map_of(*key->solution);
    if (!map) return nullptr;
    auto own = std::make_unique<LogKey>(LogKey{*map, *key->extremes, *key->f, key->time});
    const double turns =
        std::round((key->rotation - between_->mean_argument(own->map)) / (2 * kPi));
    own->map.l.array() += 2 * kPi * turns * kI;
    return own;
  }

  MotionSetting setting_;
  std::shared_ptr<const LogInbetween> between_;
};

}  // namespace

std::shared_ptr<const ProvedMotion> proved_motion(MotionSetting setting) {
  return std::make_shared<const LogMotion>(std::move(setting));
}

}  // namespace holomorph
