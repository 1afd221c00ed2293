// Splits a deformation into the two inputs of its map, the rest state and the pose.
#include "scene/deformation.h"

#include "core/error.h"

namespace holomorph {

Rest rest_of(const Deformation& deformation, Precision precision) {
  if (!deformation.has_cage())
    throw Error(ErrorKind::bad_input,
                "the scene has no cage yet; draw one, or make one with 'holomorph new'");
  Rest rest;
  rest.cage = deformation.rest;
  const auto raise_to = [&](const Cage& posed) {
    for (Index i = 0; i < posed.size(); ++i)
      if (posed.degree(i) > rest.cage.degree(i)) rest.cage = elevated_to(rest.cage, posed);
  };
  raise_to(deformation.pose);
  for (const Keyframe& key : deformation.keyframes)
    if (fits(deformation, key.pose)) raise_to(key.pose.cage);
  for (const Pin& pin : deformation.pins)
    rest.pins.push_back({pin.rest, pin.angle.has_value(), pin.radius});
  for (const Stroke& stroke : deformation.strokes) rest.strokes.push_back(stroke.rest);
  for (const Corner& corner : deformation.corners) rest.corners.push_back(corner.vertex);
  rest.outline = deformation.outline;
  rest.stiffness = deformation.stiffness;
  rest.frame = deformation.frame;
  rest.held_beyond = deformation.held_beyond;
  rest.parameters = deformation.parameters;
  rest.other_parameters = deformation.other_parameters;
  rest.precision = precision;
  return used_by(method_named(deformation.method), std::move(rest));
}

Pose whole_pose_of(const Deformation& deformation) {
  Pose pose{deformation.pose, {}};
  for (const Pin& pin : deformation.pins)
    pose.pins.push_back({pin.pose, pin.angle.value_or(0.0), pin.scale, pin.turn});
  for (const Stroke& stroke : deformation.strokes) pose.strokes.push_back(stroke.pose);
  for (const Corner& corner : deformation.corners) pose.corners.push_back(corner.pose);
  return pose;
}

Pose pose_of(const Deformation& deformation) {
  return used_by(method_named(deformation.method), whole_pose_of(deformation));
}

// If a pose has no corners, it was stored before the list of corners existed. All corners are then
// at rest.
bool fits(const Deformation& deformation, const Pose& pose) {
  return pose.cage.size() == deformation.rest.size() &&
         pose.cage.starts == deformation.rest.starts && pose.cage.parts == deformation.rest.parts &&
         pose.pins.size() == deformation.pins.size() &&
         pose.strokes.size() == deformation.strokes.size() &&
         (pose.corners.empty() || pose.corners.size() == deformation.corners.size());
}

Deformation posed_as(Deformation deformation, const Pose& pose) {
  check(fits(deformation, pose), "posed_as: the pose fits");
  deformation.pose = pose.cage;
  for (size_t i = 0; i < deformation.pins.size(); ++i) {
    Pin& pin = deformation.pins[i];
    pin.pose = pose.pins[i].position;
    if (pin.angle) pin.angle = pose.pins[i].angle;
    pin.scale = pose.pins[i].scale;
    pin.turn = pose.pins[i].turn;
  }
  for (size_t i = 0; i < deformation.strokes.size(); ++i)
    deformation.strokes[i].pose = pose.strokes[i];
  for (size_t i = 0; i < deformation.corners.size(); ++i)
    deformation.corners[i].pose = pose.corners.empty() ? PoseCorner{} : pose.corners[i];
  return deformation;
}

Deformation at_rest(Deformation deformation) {
  deformation.pose = deformation.rest;
  for (Pin& pin : deformation.pins) {
    pin.pose = pin.rest;
    if (pin.angle) pin.angle = 0.0;
    if (pin.turn) pin.turn = 0.0;
    pin.scale = 1;
  }
  for (Stroke& stroke : deformation.strokes) stroke.pose = stroke.rest;
  for (Corner& corner : deformation.corners) corner.pose = {};
  return deformation;
}

Deformation with_cage(Deformation deformation, Cage cage) {
  deformation.rest = std::move(cage);
  deformation.corners.clear();  // the vertices have changed
  deformation.loop_extras.clear();
  return at_rest(std::move(deformation));
}

Deformation with_cage(Deformation deformation, const Points& polygon) {
  return with_cage(std::move(deformation), polygon_cage(polygon));
}

}  // namespace holomorph
