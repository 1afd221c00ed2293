#include "scene/scene.h"

#include <utility>

namespace holomorph {

bool Layer::operator==(const Layer& other) const {
  return name == other.name && visible == other.visible && locked == other.locked &&
         opacity == other.opacity && blending == other.blending && clipped == other.clipped &&
         image == other.image && deformation == other.deformation &&
         attachment == other.attachment && placement == other.placement && extra == other.extra;
}

Scene with_layer(Scene scene, Layer layer) {
  scene.layers[scene.edited] = std::move(layer);
  return scene;
}

Scene with_deformation(Scene scene, Deformation deformation) {
  Layer layer = scene.layer();
  layer.deformation = std::move(deformation);
  return with_layer(std::move(scene), std::move(layer));
}

Scene scene_of(Layer layer) {
  return with_layer(Scene{}, std::move(layer));
}

Scene scene_of(Deformation deformation) {
  return with_deformation(Scene{}, std::move(deformation));
}

}  // namespace holomorph
