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
  for (const Keyframe& key : scene.keyframes)
    if (fits(scene, key.pose)) rest.cage = elevated_to(rest.cage, key.pose.cage);
  for (const Pin& pin : scene.pins) rest.pins.push_back({pin.rest, pin.angle.has_value()});
  for (const Stroke& stroke : scene.strokes) rest.strokes.push_back(stroke.rest);
  for (const Corner& corner : scene.corners) rest.corners.push_back(corner.vertex);
  rest.outline = scene.outline;
  rest.stiffness = scene.stiffness;
  rest.parameters = scene.parameters;
  rest.other_parameters = scene.other_parameters;
  rest.precision = precision;
  return used_by(method_named(scene.method), std::move(rest));
}

Pose whole_pose_of(const Scene& scene) {
  Pose pose{scene.pose, {}};
  for (const Pin& pin : scene.pins)
    pose.pins.push_back({pin.pose, pin.angle.value_or(0.0), pin.scale});
  for (const Stroke& stroke : scene.strokes) pose.strokes.push_back(stroke.pose);
  for (const Corner& corner : scene.corners) pose.corners.push_back(corner.pose);
  return pose;
}

Pose pose_of(const Scene& scene) {
  return used_by(method_named(scene.method), whole_pose_of(scene));
}

// A pose without corners is one from before they were listed: none of them had turned.
bool fits(const Scene& scene, const Pose& pose) {
  return pose.cage.size() == scene.rest.size() && pose.pins.size() == scene.pins.size() &&
         pose.strokes.size() == scene.strokes.size() &&
         (pose.corners.empty() || pose.corners.size() == scene.corners.size());
}

Scene posed_as(Scene scene, const Pose& pose) {
  check(fits(scene, pose), "posed_as: the pose fits");
  scene.pose = pose.cage;
  for (size_t i = 0; i < scene.pins.size(); ++i) {
    Pin& pin = scene.pins[i];
    pin.pose = pose.pins[i].position;
    if (pin.angle) pin.angle = pose.pins[i].angle;
    pin.scale = pose.pins[i].scale;
  }
  for (size_t i = 0; i < scene.strokes.size(); ++i) scene.strokes[i].pose = pose.strokes[i];
  for (size_t i = 0; i < scene.corners.size(); ++i)
    scene.corners[i].pose = pose.corners.empty() ? PoseCorner{} : pose.corners[i];
  return scene;
}

Scene at_rest(Scene scene) {
  scene.pose = scene.rest;
  for (Pin& pin : scene.pins) {
    pin.pose = pin.rest;
    if (pin.angle) pin.angle = 0.0;
    pin.scale = 1;
  }
  for (Stroke& stroke : scene.strokes) stroke.pose = stroke.rest;
  for (Corner& corner : scene.corners) corner.pose = {};
  return scene;
}

Scene with_cage(Scene scene, Cage cage) {
  scene.rest = std::move(cage);
  scene.corners.clear();  // other vertices
  return at_rest(std::move(scene));
}

Scene with_cage(Scene scene, const Points& polygon) {
  return with_cage(std::move(scene), polygon_cage(polygon));
}

}  // namespace holomorph
