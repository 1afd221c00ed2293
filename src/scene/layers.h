// Edits to a scene's stack of layers. Layers are numbered from bottom to top.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The index of the layer with this id; the number of layers if there is none.
size_t layer_index(const Scene& scene, int id);
/// Makes sure that no layer will be given an id up to this one.
void reserve_layer_ids(int last);
/// The layer's name. If it is empty, the name of the layer's picture. If there is no picture
/// either, "Layer" and the layer's number, counting from 1.
std::string title_of_layer(const Scene& scene, size_t layer);
/// The layer to which a clipped layer is clipped: the nearest one below that is not clipped itself.
/// None if the layer is not clipped, or if there is no such layer.
std::optional<size_t> clip_base(const Scene& scene, size_t layer);
/// Whether a layer is visible, and so is the layer to which it is clipped.
bool is_shown(const Scene& scene, size_t layer);
/// Whether a layer is not simply drawn over those below it.
bool is_blended(const Layer& layer);
/// Whether the scene is more than a single plain layer.
bool has_layers(const Scene& scene);

/// Replaces the layer at this index. The new layer takes over the id of the old one.
Scene with_layer_at(Scene scene, size_t number, Layer layer);
/// Adds the layers of another scene above the edited layer. The edited layer of `added` becomes the
/// edited layer of the result. Added layers get new ids, and attachments among them follow these.
/// Throws Error if the result would have more than kMaxLayers layers.
Scene with_layers_added(Scene scene, const Scene& added);
/// Duplicates the edited layer. The copy is placed above it and becomes the edited layer.
Scene with_layer_duplicated(const Scene& scene);
/// Removes the edited layer, which must not be the only one. The layer below it becomes the edited
/// layer, or the layer above it if there is none below.
Scene without_layer(Scene scene);
/// Moves the edited layer to another index, which must exist.
Scene with_layer_moved(Scene scene, size_t to);

/// The scene without the original behind a single layer.
Scene without_original(Scene scene);

/// Replaces the animation settings.
Scene with_animation(Scene scene, const AnimationSettings& settings);

/// Copies of the layers, for editing; shared() converts them back.
std::vector<Layer> layers_of(const Scene& scene);
std::vector<SharedLayer> shared(std::vector<Layer> layers);

}  // namespace holomorph
