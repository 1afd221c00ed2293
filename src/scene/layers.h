// Edits of a scene's stack of layers, numbered from the bottom to the top.
#pragma once

#include "scene/scene.h"

namespace holomorph {

inline constexpr size_t kMostLayers = 100;

/// The number of the layer with this id; none: the number of layers.
size_t layer_of_id(const Scene& scene, int id);
/// Its name, its picture's, or "Layer 2".
std::string title_of_layer(const Scene& scene, size_t layer);
/// Whether the scene is more than one plain layer.
bool has_layers(const Scene& scene);

/// With a layer in place of the one of this number, whose id it keeps.
Scene with_layer_at(Scene scene, size_t number, Layer layer);
/// With the layers of another scene above the edited one; that one's edited layer is edited from
/// then on. Throws Error when there would be more than kMostLayers.
Scene with_layers_added(Scene scene, const Scene& added);
/// A copy of the edited layer, above it and edited.
Scene with_layer_doubled(const Scene& scene);
/// Without the edited layer: the one below is edited, or the one above. There must be another.
Scene without_layer(Scene scene);
/// The edited layer moved to another number, which must exist.
Scene with_layer_moved(Scene scene, size_t to);

/// With other animation settings.
Scene with_animation(Scene scene, const AnimationSettings& settings);

/// The layers, to be changed and put back.
std::vector<Layer> layers_of(const Scene& scene);
std::vector<SharedLayer> shared(std::vector<Layer> layers);

}  // namespace holomorph
