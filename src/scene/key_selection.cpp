// Each edit changes the layers that have selected keyframes, one after another.
#include "scene/key_selection.h"

#include <algorithm>
#include <cmath>

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
  const KeySelection keys = editable_keys(scene, selected);
  const double rate = scene.animation.frames_per_second;
  const auto moved = [&](double time) {
    const double to = map(time);
    return how.to_frames ? std::round(to * rate) / rate : to;
  };
  bool possible = true;
  MovedKeys result;
  result.scene =
      with_each_layer(scene, keys, [&](Deformation deformation, const std::vector<size_t>& chosen) {
        std::vector<Keyframe> moving;
        for (const size_t k : chosen) {
          moving.push_back(deformation.keyframes[k]);
          // Whole turns are made since the key before, which a copy may not have before it.
          if (how.copies && (k == 0 || !std::ranges::binary_search(chosen, k - 1)))
            moving.back().turns = 0;
        }
        if (!how.copies)
          for (size_t i = chosen.size(); i-- > 0;)
            deformation = without_key(std::move(deformation), chosen[i]);
        for (Keyframe& key : moving) {
          key.time = moved(key.time);
          possible = possible && key.time >= 0 && key.time <= kMaxTime &&
                     key_at(deformation, key.time) == deformation.keyframes.size();
          if (!possible) break;
          const auto next =
              std::ranges::upper_bound(deformation.keyframes, key.time, {}, &Keyframe::time);
          deformation.keyframes.insert(next, key);
        }
        return deformation;
      });
  if (!possible) return {};
  for (const KeyId& key : keys) result.keys.insert({key.layer, moved(key.time)});
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
