// Each edit changes the layers that have selected keyframes, one after another.
#include "scene/key_selection.h"

#include <algorithm>
#include <cmath>

#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/mirror.h"

namespace holomorph {
namespace {

/// Calls edit(deformation, indices) for each layer with the indices of its selected keyframes, and
/// returns the scene with the deformations that it returns.
template <class Edit>
Scene with_each_layer(Scene scene, const KeySelection& keys, Edit edit) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    std::vector<size_t> chosen;
    for (size_t k = 0; k < layer.deformation.keyframes.size(); ++k)
      if (keys.contains({layer.id, layer.deformation.keyframes[k].time})) chosen.push_back(k);
    if (chosen.empty()) continue;
    Layer changed = layer;
    changed.deformation = edit(std::move(changed.deformation), chosen);
    scene = with_layer_at(std::move(scene), i, std::move(changed));
  }
  return scene;
}

double moved_time(const Scene& scene, const TimeMap& map, double time, bool to_frames) {
  const double to = map(time), rate = scene.animation.frames_per_second;
  return to_frames ? std::round(to * rate) / rate : to;
}

bool is_allowed_time(double time) {
  return time >= 0 && time <= kMaxTime;
}

bool is_same_time(const Keyframe& a, const Keyframe& b) {
  return std::abs(a.time - b.time) < kSameTime;
}

/// A keyframe in its new place.
struct PlacedKey {
  Keyframe key;
  size_t from = 0;  ///< its index before
  bool moved = false;
};

/// The whole turns since the key before. A moved key keeps them if it still follows the same key. A
/// key that stays turns as often as before since the last other key that stays.
int turns_of(const std::vector<PlacedKey>& placed, size_t i, const std::vector<Keyframe>& before) {
  const PlacedKey& key = placed[i];
  if (i == 0) return key.from == 0 ? key.key.turns : 0;
  const PlacedKey& last = placed[i - 1];
  const bool follows = last.from + 1 == key.from;
  if (key.moved) return follows ? key.key.turns : 0;
  if (follows) return key.key.turns;
  int turns = key.key.turns;
  const auto is_left = [&](size_t k) {
    return std::ranges::any_of(placed, [&](const PlacedKey& other) {
      return other.from == k && (!other.moved || &other < &key);
    });
  };
  for (size_t k = key.from; k-- > 0 && !is_left(k);) turns += before[k].turns;
  return std::clamp(turns, -kMaxTurns, kMaxTurns);
}

}  // namespace

KeySelection all_keys(const Scene& scene) {
  KeySelection all;
  for (const SharedLayer& layer : scene.layers)
    for (const Keyframe& key : layer->deformation.keyframes) all.insert({layer->id, key.time});
  return all;
}

KeySelection editable_keys(const Scene& scene, const KeySelection& keys) {
  KeySelection open;
  for (const SharedLayer& layer : scene.layers)
    for (const Keyframe& key : layer->deformation.keyframes)
      if (layer->visible && !layer->locked && keys.contains({layer->id, key.time}))
        open.insert({layer->id, key.time});
  return open;
}

std::pair<double, double> span_of(const KeySelection& keys) {
  const auto [first, last] = std::ranges::minmax_element(keys, {}, &KeyId::time);
  return {first->time, last->time};
}

std::optional<MovedKeys> with_keys_moved(const Scene& scene, const KeySelection& selected,
                                         const TimeMap& map, KeyMove how) {
  if (how.copies) return with_keys_pasted(scene, copied_keys(scene, selected), map, how.to_frames);
  const KeySelection keys = editable_keys(scene, selected);
  const auto moved = [&](double time) { return moved_time(scene, map, time, how.to_frames); };
  bool possible = true;
  MovedKeys result;
  result.scene =
      with_each_layer(scene, keys, [&](Deformation deformation, const std::vector<size_t>& chosen) {
        const std::vector<Keyframe> before = deformation.keyframes;
        std::vector<PlacedKey> placed;
        for (size_t k = 0; k < before.size(); ++k)
          if (!std::ranges::binary_search(chosen, k)) placed.push_back({before[k], k, false});
        for (const size_t k : chosen) {
          PlacedKey key{before[k], k, true};
          key.key.time = moved(key.key.time);
          const auto next = std::ranges::upper_bound(
              placed, key.key.time, {}, [](const PlacedKey& other) { return other.key.time; });
          const auto meets = [&](const PlacedKey& other) {
            return is_same_time(other.key, key.key);
          };
          possible =
              possible && is_allowed_time(key.key.time) && std::ranges::none_of(placed, meets);
          if (!possible) return deformation;
          placed.insert(next, std::move(key));
        }
        deformation.keyframes.clear();
        for (size_t i = 0; i < placed.size(); ++i) {
          deformation.keyframes.push_back(placed[i].key);
          deformation.keyframes.back().turns = turns_of(placed, i, before);
        }
        return deformation;
      });
  if (!possible) return {};
  for (const KeyId& key : keys) result.keys.insert({key.layer, moved(key.time)});
  return result;
}

CopiedKeys copied_keys(const Scene& scene, const KeySelection& selected) {
  const KeySelection keys = editable_keys(scene, selected);
  CopiedKeys copied;
  for (const SharedLayer& layer : scene.layers) {
    bool follows = false;
    for (const Keyframe& key : layer->deformation.keyframes) {
      const bool chosen = keys.contains({layer->id, key.time});
      if (chosen) {
        copied.layers[layer->id].push_back(key);
        if (!follows) copied.layers[layer->id].back().turns = 0;
      }
      follows = chosen;
    }
  }
  return copied;
}

KeySelection CopiedKeys::keys() const {
  KeySelection all;
  for (const auto& [layer, copies] : layers)
    for (const Keyframe& key : copies) all.insert({layer, key.time});
  return all;
}

CopiedKeys fitting(const Scene& scene, CopiedKeys copied) {
  std::erase_if(copied.layers, [&](const auto& entry) {
    const auto& [id, copies] = entry;
    const size_t i = layer_index(scene, id);
    if (i == scene.layers.size()) return true;
    const Layer& layer = *scene.layers[i];
    return !layer.visible || layer.locked || !std::ranges::all_of(copies, [&](const Keyframe& key) {
      return fits(layer.deformation, key.pose);
    });
  });
  return copied;
}

std::optional<MovedKeys> with_keys_pasted(const Scene& scene, const CopiedKeys& copied,
                                          const TimeMap& map, bool to_frames) {
  MovedKeys result{scene, {}};
  for (const auto& [id, copies] : copied.layers) {
    const size_t i = layer_index(scene, id);
    Layer layer = *scene.layers[i];
    std::vector<Keyframe>& keys = layer.deformation.keyframes;
    std::optional<double> last;  // the time of the copy before
    for (Keyframe key : copies) {
      key.time = moved_time(scene, map, key.time, to_frames);
      const auto meets = [&](const Keyframe& other) { return is_same_time(other, key); };
      if (!is_allowed_time(key.time) || std::ranges::any_of(keys, meets)) return {};
      const auto next = std::ranges::upper_bound(keys, key.time, {}, &Keyframe::time);
      // Copies turn only if no other key lies between them.
      const bool follows = last && next != keys.begin() && std::prev(next)->time == *last;
      if (!follows) key.turns = 0;
      last = key.time;
      result.keys.insert({id, key.time});
      keys.insert(next, std::move(key));
    }
    result.scene = with_layer_at(std::move(result.scene), i, std::move(layer));
  }
  return result;
}

Scene with_keys_eased(Scene scene, const KeySelection& keys, Ease ease) {
  return with_each_layer(std::move(scene), keys,
                         [&](Deformation deformation, const std::vector<size_t>& chosen) {
                           for (const size_t k : chosen) deformation.keyframes[k].ease = ease;
                           return deformation;
                         });
}

Scene without_keys(Scene scene, const KeySelection& keys) {
  return with_each_layer(
      std::move(scene), keys, [&](Deformation deformation, const std::vector<size_t>& chosen) {
        for (size_t i = chosen.size(); i-- > 0;) {
          const size_t k = chosen[i];
          // The picture turns as often as before between the keys around it.
          if (k > 0 && k + 1 < deformation.keyframes.size()) {
            int& turns = deformation.keyframes[k + 1].turns;
            turns = std::clamp(turns + deformation.keyframes[k].turns, -kMaxTurns, kMaxTurns);
          }
          deformation = without_key(std::move(deformation), k);
        }
        return deformation;
      });
}

Scene with_keys_mirrored(Scene scene, const KeySelection& keys) {
  return with_each_layer(std::move(scene), keys,
                         [&](Deformation deformation, const std::vector<size_t>& chosen) {
                           for (const size_t k : chosen) {
                             Keyframe& key = deformation.keyframes[k];
                             if (!fits(deformation, key.pose)) continue;
                             key.pose = mirrored(deformation, key.pose);
                             // Turns between two mirrored keys go the other way.
                             if (k > 0 && std::ranges::binary_search(chosen, k - 1))
                               key.turns = -key.turns;
                           }
                           return deformation;
                         });
}

std::optional<Ease> common_ease(const Scene& scene, const KeySelection& keys) {
  std::optional<Ease> common;
  for (const SharedLayer& layer : scene.layers)
    for (const Keyframe& key : layer->deformation.keyframes) {
      if (!keys.contains({layer->id, key.time})) continue;
      if (common && *common != key.ease) return {};
      common = key.ease;
    }
  return common;
}

}  // namespace holomorph
