// The layers of a scene, numbered from the bottom to the top. One of them is edited: it is the
// scene itself.
#pragma once

#include "scene/scene.h"

namespace holomorph {

inline constexpr size_t kMostLayers = 100;

inline size_t layer_count(const Scene& scene) {
  return scene.below.size() + 1 + scene.above.size();
}
inline size_t edited_layer(const Scene& scene) {
  return scene.below.size();
}
const Scene& layer_at(const Scene& scene, size_t layer);
/// The layer of this id; none: layer_count.
size_t layer_of_id(const Scene& scene, int id);
/// Its name, its picture's, or "Layer 2".
std::string title_of_layer(const Scene& scene, size_t layer);
/// Whether the scene is more than one plain layer.
bool has_layers(const Scene& scene);

/// The same scene with another of its layers edited.
Scene with_layer_chosen(Scene scene, size_t layer);
/// With the layers of another scene above the edited one; that one's edited layer is edited from
/// then on.
Scene with_layer_added(Scene scene, const Scene& added);
/// A copy of the edited layer, above it and edited.
Scene with_layer_doubled(const Scene& scene);
/// Without the edited layer: the one below is edited, or the one above. There must be another.
Scene without_layer(Scene scene);
/// The edited layer at another place, which must be one.
Scene with_layer_moved(Scene scene, size_t to);
/// A layer with another name, visibility or lock.
Scene with_layer_state(Scene scene, size_t layer, LayerState state);
/// With animation settings, which all layers share.
Scene with_animation(Scene scene, const AnimationSettings& settings);

/// Puts layers together, the first one lowest; `edited` is one of them. What all layers share is
/// `shared`'s. Ids that are 0 or taken are given anew.
Scene scene_of_layers(std::vector<Scene> layers, size_t edited, const Scene& shared);
/// The layers, each alone.
std::vector<Scene> layers_of(const Scene& scene);

}  // namespace holomorph
