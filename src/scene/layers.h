// Edits of a scene's stack of layers, which are numbered from bottom to top.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The index of the layer with this id; the number of layers if there is none.
size_t layer_index(const Scene& scene, int id);
/// The layer's name, else that of its picture, else "Layer 2" for the second one.
std::string title_of_layer(const Scene& scene, size_t layer);
/// Whether the scene is anything other than a single plain layer.
bool has_layers(const Scene& scene);

/// Replaces the layer at this index; the replacement takes over its id.
Scene with_layer_at(Scene scene, size_t number, Layer layer);
/// Adds the layers of another scene above the edited one. The edited layer of `added` becomes the
/// edited layer. Throws Error if there would be more than kMaxLayers.
Scene with_layers_added(Scene scene, const Scene& added);
/// Adds a copy of the edited layer above it, which becomes the edited layer.
Scene with_layer_duplicated(const Scene& scene);
/// Removes the edited layer. The layer below it becomes the edited one, or the layer above it if
/// there is none below. There must be another layer.
Scene without_layer(Scene scene);
/// Moves the edited layer to another index, which must exist.
Scene with_layer_moved(Scene scene, size_t to);

/// Replaces the animation settings.
Scene with_animation(Scene scene, const AnimationSettings& settings);

/// Copies of the layers, for editing; shared() converts them back.
std::vector<Layer> layers_of(const Scene& scene);
std::vector<SharedLayer> shared(std::vector<Layer> layers);

}  // namespace holomorph
