// Scenes with one change.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// Changes the deformation of the edited layer.
template <class Change>
void change(Scene& scene, Change change) {
  Deformation deformation = scene.deformation();
  change(deformation);
  scene = with_deformation(std::move(scene), std::move(deformation));
}

/// Changes the edited layer.
template <class Change>
void change_layer(Scene& scene, Change change) {
  Layer layer = scene.layer();
  change(layer);
  scene = with_layer(std::move(scene), std::move(layer));
}

/// The scene with this cage, in its rest pose.
inline Scene scene_with_cage(const Scene& scene, const Points& polygon) {
  return with_deformation(scene, with_cage(scene.deformation(), polygon));
}

}  // namespace holomorph
