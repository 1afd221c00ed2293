// The two halves of a scene that maps are made of.
#include "scene/scene.h"

#include "core/error.h"

namespace holomorph {

Rest rest_of(const Scene& scene, Precision precision) {
  if (!scene.has_cage())
    throw Error(ErrorKind::bad_input,
                "the scene has no cage yet; draw one, or make one with 'holomorph new'");
  Rest rest;
  rest.cage = elevated_to(scene.rest, scene.pose);
  if (method_named(scene.method).uses_pins)
    for (const Pin& pin : scene.pins) rest.pins.push_back({pin.rest, pin.angle.has_value()});
  rest.parameters = scene.parameters;
  rest.precision = precision;
  return rest;
}

Pose pose_of(const Scene& scene) {
  Pose pose{scene.pose, {}, scene.outline};
  if (method_named(scene.method).uses_pins)
    for (const Pin& pin : scene.pins)
      pose.pins.push_back({pin.pose, pin.angle.value_or(0.0), pin.scale});
  return pose;
}

Scene at_rest(Scene scene) {
  scene.pose = scene.rest;
  for (Pin& pin : scene.pins) {
    pin.pose = pin.rest;
    if (pin.angle) pin.angle = 0.0;
    pin.scale = 1;
  }
  return scene;
}

Scene with_cage(Scene scene, Cage cage) {
  scene.rest = std::move(cage);
  return at_rest(std::move(scene));
}

Scene with_cage(Scene scene, const Points& polygon) {
  return with_cage(std::move(scene), polygon_cage(polygon));
}

}  // namespace holomorph
