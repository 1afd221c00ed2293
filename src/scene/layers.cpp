// Layers are shared values: an edit copies only the layer that it changes.
#include "scene/layers.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>

#include "core/error.h"

namespace holomorph {

namespace {

/// An id that has never been used before, not even by a deleted layer, because undo may bring that
/// layer back.
std::atomic<int> last_layer_id = 1'000'000;
int fresh_layer_id() {
  return ++last_layer_id;
}

}  // namespace

void reserve_layer_ids(int last) {
  for (int known = last_layer_id; known < last;)
    if (last_layer_id.compare_exchange_weak(known, last)) return;
}

size_t layer_index(const Scene& scene, int id) {
  const auto found =
      std::ranges::find(scene.layers, id, [](const SharedLayer& l) { return l->id; });
  return static_cast<size_t>(found - scene.layers.begin());
}

std::string title_of_layer(const Scene& scene, size_t layer) {
  const Layer& it = *scene.layers[layer];
  if (!it.name.empty()) return it.name;
  if (it.image) return std::filesystem::path(it.image->file).stem().string();
  return "Layer " + std::to_string(layer + 1);
}

std::optional<size_t> clip_base(const Scene& scene, size_t layer) {
  if (!scene.layers[layer]->clipped) return {};
  while (layer-- > 0)
    if (!scene.layers[layer]->clipped) return layer;
  return {};
}

bool is_shown(const Scene& scene, size_t layer) {
  const std::optional<size_t> base = clip_base(scene, layer);
  return scene.layers[layer]->visible && (!base || scene.layers[*base]->visible);
}

bool is_blended(const Layer& layer) {
  return layer.opacity < 1 || layer.blending != Blending::normal || layer.clipped;
}

bool has_layers(const Scene& scene) {
  const Layer& layer = scene.layer();
  return scene.layers.size() > 1 || !layer.name.empty() || !layer.visible || layer.locked ||
         is_blended(layer) || !is_identity(layer.placement) || !layer.extra.empty();
}

Scene with_layer_at(Scene scene, size_t number, Layer layer) {
  layer.id = scene.layers[number]->id;
  scene.layers[number] = std::move(layer);
  return scene;
}

Scene with_layers_added(Scene scene, const Scene& added) {
  if (scene.layers.size() + added.layers.size() > kMaxLayers)
    throw Error(ErrorKind::bad_input,
                "a scene has at most " + std::to_string(kMaxLayers) + " layers");
  std::vector<Layer> more = layers_of(added);
  std::map<int, int> fresh;
  for (Layer& layer : more) layer.id = fresh[layer.id] = fresh_layer_id();
  for (Layer& layer : more)
    if (layer.attachment && fresh.contains(layer.attachment->layer))
      layer.attachment->layer = fresh[layer.attachment->layer];
  const std::vector<SharedLayer> above = shared(std::move(more));
  const size_t place = scene.edited + 1;
  scene.layers.insert(scene.layers.begin() + static_cast<long>(place), above.begin(), above.end());
  scene.edited = place + added.edited;
  return scene;
}

Scene with_layer_duplicated(const Scene& scene) {
  Layer copy = scene.layer();
  copy.name = title_of_layer(scene, scene.edited) + " copy";
  return with_layers_added(scene, scene_of(std::move(copy)));
}

Scene without_layer(Scene scene) {
  check(scene.layers.size() > 1, "without_layer: one layer is left");
  scene.layers.erase(scene.layers.begin() + static_cast<long>(scene.edited));
  if (scene.edited > 0) --scene.edited;
  return scene;
}

Scene with_layer_moved(Scene scene, size_t to) {
  check(to < scene.layers.size(), "with_layer_moved: the index is in the stack");
  const auto from = scene.layers.begin() + static_cast<long>(scene.edited),
             target = scene.layers.begin() + static_cast<long>(to);
  if (from < target)
    std::rotate(from, from + 1, target + 1);
  else
    std::rotate(target, from, from + 1);
  scene.edited = to;
  return scene;
}

Scene without_original(Scene scene) {
  if (scene.layers.size() == 1 && scene.background.fill == Background::Fill::original)
    scene.background.fill = Background::Fill::transparent;
  return scene;
}

Scene with_animation(Scene scene, const AnimationSettings& settings) {
  scene.animation = settings;
  return scene;
}

std::vector<Layer> layers_of(const Scene& scene) {
  std::vector<Layer> layers;
  for (const SharedLayer& layer : scene.layers) layers.push_back(*layer);
  return layers;
}

std::vector<SharedLayer> shared(std::vector<Layer> layers) {
  return {std::make_move_iterator(layers.begin()), std::make_move_iterator(layers.end())};
}

}  // namespace holomorph
