// Every change takes the stack apart and puts it together again: stacks are short.
#include "scene/layers.h"

#include <atomic>
#include <filesystem>

#include "core/error.h"

namespace holomorph {

OtherLayer::OtherLayer(Scene layer) : layer_(std::make_shared<const Scene>(std::move(layer))) {}

bool OtherLayer::operator==(const OtherLayer& other) const {
  return layer_ == other.layer_ || *layer_ == *other.layer_;
}

namespace {

/// Never one that was given before, though its layer be gone: the history may bring it back.
int fresh_id() {
  static std::atomic<int> last = 1'000'000;
  return ++last;
}

/// Without others and without what all layers share but the settings that each of them plays by.
Scene alone(Scene layer) {
  layer.below.clear();
  layer.above.clear();
  layer.background = {};
  layer.animation_extra.clear();
  layer.extra.clear();
  return layer;
}

}  // namespace

const Scene& layer_at(const Scene& scene, size_t layer) {
  check(layer < layer_count(scene), "layer_at: there is such a layer");
  const size_t edited = edited_layer(scene);
  return layer < edited    ? *scene.below[layer]
         : layer == edited ? scene
                           : *scene.above[layer - edited - 1];
}

size_t layer_of_id(const Scene& scene, int id) {
  size_t layer = 0;
  while (layer < layer_count(scene) && layer_at(scene, layer).layer.id != id) ++layer;
  return layer;
}

std::string title_of_layer(const Scene& scene, size_t layer) {
  const Scene& it = layer_at(scene, layer);
  if (!it.layer.name.empty()) return it.layer.name;
  if (it.image) return std::filesystem::path(it.image->file).stem().string();
  return "Layer " + std::to_string(layer + 1);
}

bool has_layers(const Scene& scene) {
  return layer_count(scene) > 1 || scene.layer != LayerState{};
}

std::vector<Scene> layers_of(const Scene& scene) {
  std::vector<Scene> layers;
  for (size_t i = 0; i < layer_count(scene); ++i) layers.push_back(alone(layer_at(scene, i)));
  return layers;
}

Scene scene_of_layers(std::vector<Scene> layers, size_t edited, const Scene& shared) {
  check(edited < layers.size(), "scene_of_layers: one of the layers is edited");
  for (size_t i = 0; i < layers.size(); ++i) {
    LayerState& state = layers[i].layer;
    bool taken = state.id == 0;
    for (size_t j = 0; j < i; ++j) taken = taken || layers[j].layer.id == state.id;
    if (taken && layers.size() > 1) state.id = fresh_id();
    layers[i].animation = shared.animation;
  }
  Scene scene = std::move(layers[edited]);
  scene.background = shared.background;
  scene.animation_extra = shared.animation_extra;
  scene.extra = shared.extra;
  for (size_t i = 0; i < layers.size(); ++i)
    if (i != edited) (i < edited ? scene.below : scene.above).emplace_back(std::move(layers[i]));
  return scene;
}

Scene with_layer_chosen(Scene scene, size_t layer) {
  if (layer == edited_layer(scene)) return scene;
  return scene_of_layers(layers_of(scene), layer, scene);
}

Scene with_layer_added(Scene scene, const Scene& added) {
  if (layer_count(scene) + layer_count(added) > kMostLayers)
    throw Error(ErrorKind::bad_input, "a scene has at most 100 layers");
  std::vector<Scene> layers = layers_of(scene), more = layers_of(added);
  const size_t place = edited_layer(scene) + 1;
  for (Scene& layer : more) layer.layer.id = 0;
  layers.insert(layers.begin() + static_cast<long>(place), more.begin(), more.end());
  return scene_of_layers(std::move(layers), place + edited_layer(added), scene);
}

Scene with_layer_doubled(const Scene& scene) {
  Scene copy = alone(scene);
  copy.layer.name = title_of_layer(scene, edited_layer(scene)) + " copy";
  return with_layer_added(scene, copy);
}

Scene without_layer(Scene scene) {
  check(layer_count(scene) > 1, "without_layer: one stays");
  std::vector<Scene> layers = layers_of(scene);
  const size_t gone = edited_layer(scene);
  layers.erase(layers.begin() + static_cast<long>(gone));
  return scene_of_layers(std::move(layers), gone > 0 ? gone - 1 : 0, scene);
}

Scene with_layer_moved(Scene scene, size_t to) {
  std::vector<Scene> layers = layers_of(scene);
  check(to < layers.size(), "with_layer_moved: a place in the stack");
  const auto from = layers.begin() + static_cast<long>(edited_layer(scene)),
             target = layers.begin() + static_cast<long>(to);
  if (from < target)
    std::rotate(from, from + 1, target + 1);
  else
    std::rotate(target, from, from + 1);
  return scene_of_layers(std::move(layers), to, scene);
}

Scene with_layer_state(Scene scene, size_t layer, LayerState state) {
  state.id = layer_at(scene, layer).layer.id;
  if (layer == edited_layer(scene)) {
    scene.layer = std::move(state);
    return scene;
  }
  std::vector<Scene> layers = layers_of(scene);
  layers[layer].layer = std::move(state);
  return scene_of_layers(std::move(layers), edited_layer(scene), scene);
}

Scene with_animation(Scene scene, const AnimationSettings& settings) {
  scene.animation = settings;
  return scene_of_layers(layers_of(scene), edited_layer(scene), scene);
}

}  // namespace holomorph
