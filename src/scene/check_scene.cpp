// Applies the limits of the readers in formats/ to a scene in memory.
#include "scene/check_scene.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/outline/outline_match.h"
#include "scene/attachments.h"
#include "scene/budget.h"
#include "scene/clips.h"
#include "scene/formats/scene_json.h"

namespace holomorph {
namespace {

[[noreturn]] void fail(const std::string& what, std::optional<Complex> where = {}) {
  throw Error(ErrorKind::bad_input, what, where);
}

std::string numbered(const char* what, size_t i) {
  return std::string(what) + " " + std::to_string(i + 1);
}

void check_count(const std::string& what, size_t count, size_t most) {
  if (count > most)
    fail("there are " + std::to_string(count) + " " + what + "; at most " + std::to_string(most) +
         " are allowed");
}

void check_range(const std::string& what, double value, double lowest, double highest) {
  if (!(value >= lowest && value <= highest)) fail(what + " is out of range");
}

void check_point(const std::string& what, Complex z) {
  if (!is_finite(z)) fail(what + " has coordinates that are not finite");
  if (std::abs(z.real()) > kMaxCoordinate || std::abs(z.imag()) > kMaxCoordinate)
    fail(what + " has coordinates larger than 1e8", z);
}

void check_cage(const std::string& what, const Cage& cage) {
  check_count("segments in " + what, cage.segments.size(), kMaxSegments);
  check_count("holes in " + what, cage.starts.size() - cage.parts.size(), kMaxHoles);
  check_count("parts in " + what, cage.parts.size() + 1, kMaxParts);
  for (const Points& segment : cage.segments) {
    if (segment.empty()) fail(what + " has a segment without control points");
    if (segment.size() > kHighestDegree)
      fail(what + " has a segment whose degree is above " + std::to_string(kHighestDegree));
    for (const Complex& z : segment) check_point(what, z);
  }
}

void check_curve(const std::string& what, const Points& curve,
                 void (*check)(std::span<const Complex>)) {
  check_count("points in " + what, curve.size(), kMaxCurvePoints);
  for (const Complex& z : curve) check_point(what, z);
  try {
    check(curve);
  } catch (const Error& error) {
    throw Error(error.kind(), what + ": " + error.what(), error.where());
  }
}

void check_corner(const std::string& what, const PoseCorner& pose) {
  check_range(what, pose.before, -kMaxCornerTurn, kMaxCornerTurn);
  check_range(what, pose.after, -kMaxCornerTurn, kMaxCornerTurn);
  check_range(what, pose.tension, 0, 1);
}

void check_pin(const std::string& what, const PosePin& pin) {
  check_point(what, pin.position);
  check_range(what + "'s angle", pin.angle, -kMaxPinTurn, kMaxPinTurn);
  check_range(what + "'s scale", pin.scale, kMinPinScale, kMaxPinScale);
  if (pin.turn) check_range(what + "'s turn", *pin.turn, -kMaxPinTurn, kMaxPinTurn);
}

void check_handles(const Deformation& deformation) {
  check_cage("the cage", deformation.rest);
  check_cage("the posed cage", deformation.pose);
  check_same_loops(deformation.rest, deformation.pose);
  if (deformation.has_cage()) check_rest_cage(deformation.rest);
  if (!deformation.rest.parts.empty() && !method_named(deformation.method).allows_parts)
    fail("method '" + deformation.method + "' needs one outline around all parts of the cage");
  check_count("pins", deformation.pins.size(), kMaxPins);
  for (size_t i = 0; i < deformation.pins.size(); ++i) {
    const Pin& pin = deformation.pins[i];
    const std::string what = numbered("pin", i);
    check_point(what, pin.rest);
    check_pin(what, {pin.pose, pin.angle.value_or(0), pin.scale, pin.turn});
    if (pin.radius) check_range(what + "'s radius", *pin.radius, kMinPinRadius, kMaxPinRadius);
    check_range(what + "'s depth", pin.depth, -kMaxDepth, kMaxDepth);
  }
  check_count("strokes", deformation.strokes.size(), kMaxStrokes);
  for (size_t i = 0; i < deformation.strokes.size(); ++i)
    for (const Points* curve : {&deformation.strokes[i].rest, &deformation.strokes[i].pose})
      check_curve(numbered("stroke", i), *curve, check_stroke);
  Index last = -1;
  for (size_t i = 0; i < deformation.corners.size(); ++i) {
    const Corner& corner = deformation.corners[i];
    if (corner.vertex <= last || corner.vertex >= deformation.rest.size())
      fail("the corners must be sorted by vertex, and their vertices must exist");
    last = corner.vertex;
    check_corner(numbered("corner", i), corner.pose);
  }
  if (!deformation.corners.empty() && deformation.corners.size() < 3)
    fail("there must be at least three corners, or none to use all vertices");
}

void check_paint_and_outline(const Deformation& deformation) {
  check_count("brush dabs", deformation.stiffness.size(), kMaxDabs);
  for (const BrushDab& dab : deformation.stiffness) {
    check_point("a brush dab", dab.at);
    check_range("a brush dab's radius", dab.radius, kMinBrushRadius, kMaxBrushRadius);
    check_range("a brush dab's level", dab.level, -kMaxDabLevel, kMaxDabLevel);
  }
  if (!deformation.outline.empty()) check_curve("the outline", deformation.outline, check_outline);
  if (deformation.surface && deformation.outline.empty())
    fail("the surface needs its flat boundary as the outline");
}

void check_parameters(const Method& method, const Parameters& values) {
  for (const auto& [key, value] : values) {
    const auto spec = std::ranges::find(method.parameters, key, &ParameterSpec::key);
    if (spec == method.parameters.end())
      fail("method '" + method.id + "' has no parameter '" + key + "'");
    if (spec->type == ParameterSpec::Type::choice)
      check_range(spec->label, value, 0, static_cast<double>(spec->options.size()) - 1);
    else
      check_range(spec->label, value, spec->lowest, spec->highest);
  }
}

void check_keyframes(const Deformation& deformation) {
  check_count("keyframes", deformation.keyframes.size(), kMaxKeyframes);
  double last = -1;
  for (const Keyframe& key : deformation.keyframes) {
    char what[48];
    std::snprintf(what, sizeof what, "the key at %.2f s", key.time);
    check_range(what, key.time, 0, kMaxTime);
    if (!(key.time > last)) fail("the keyframes are not sorted by time");
    last = key.time;
    check_range(what, key.turns, -kMaxTurns, kMaxTurns);
    check_cage(what, key.pose.cage);
    check_count(std::string("pins in ") + what, key.pose.pins.size(), kMaxPins);
    for (const PosePin& pin : key.pose.pins) check_pin(what, pin);
    check_count(std::string("strokes in ") + what, key.pose.strokes.size(), kMaxStrokes);
    for (const Points& stroke : key.pose.strokes) check_curve(what, stroke, check_stroke);
    check_count(std::string("corners in ") + what, key.pose.corners.size(), kMaxSegments);
    for (const PoseCorner& corner : key.pose.corners) check_corner(what, corner);
  }
}

bool has_extras(const Deformation& deformation) {
  const auto kept = [](const auto& part) { return !part.extra.empty(); };
  const auto kept_in_pose = [](const Keyframe& key) { return !key.pose_extra.empty(); };
  return !deformation.cage_extra.empty() || !deformation.method_extra.empty() ||
         (deformation.surface && kept(*deformation.surface)) || !deformation.loop_extras.empty() ||
         std::ranges::any_of(deformation.pins, kept) ||
         std::ranges::any_of(deformation.strokes, kept) ||
         std::ranges::any_of(deformation.corners, kept) ||
         std::ranges::any_of(deformation.keyframes, kept) ||
         std::ranges::any_of(deformation.keyframes, kept_in_pose);
}

void check_clip(const Clip& clip) {
  check_range("the film's frame rate", clip.frames_per_second, kMinFrameRate, kMaxFrameRate);
  check_range("the film's start", clip.start, -kMaxTime, kMaxTime);
  check_range("the film's first frame", clip.first, 0, clip.last.value_or(kMaxFilmFrames));
  check_range("the film's last frame", clip.last.value_or(0), 0, kMaxFilmFrames);
  check_range("the number of the film's frames", clip.frames, 0, kMaxFilmFrames);
}

/// Whether the scene contains keys from its file that this version does not know.
bool has_extras(const Scene& scene) {
  return !scene.extra.empty() || !scene.animation_extra.empty() ||
         std::ranges::any_of(scene.layers, [](const SharedLayer& layer) {
           return !layer->extra.empty() ||
                  (layer->attachment && !layer->attachment->extra.empty()) ||
                  (layer->image && !layer->image->extra.empty()) ||
                  (clip_of(*layer) && !clip_of(*layer)->extra.empty()) ||
                  has_extras(layer->deformation);
         });
}

/// An upper bound on the bytes of a pose in a file. A point has two numbers of 24 characters, plus
/// brackets and blanks.
double size_of(const Pose& pose) {
  constexpr double kPoint = 60, kPart = 300;
  double points = static_cast<double>(pose.cage.control_count());
  for (const Points& stroke : pose.strokes) points += static_cast<double>(stroke.size());
  const double parts = static_cast<double>(pose.pins.size() + pose.corners.size());
  return kPoint * points + kPart * (parts + 1);
}

double largest_size(const Scene& scene) {
  constexpr double kDab = 120, kPoint = 60, kFixed = 20000;
  double size = kFixed;
  for (const SharedLayer& layer : scene.layers) {
    const Deformation& deformation = layer->deformation;
    size += 6.0 * static_cast<double>(layer->name.size());  // as \uXXXX
    if (layer->image) size += 6.0 * static_cast<double>(layer->image->file.size());
    if (deformation.surface) size += 6.0 * static_cast<double>(deformation.surface->file.size());
    size += kFixed + 2 * size_of(whole_pose_of(deformation)) +
            kDab * static_cast<double>(deformation.stiffness.size()) +
            kPoint * static_cast<double>(deformation.outline.size());
    for (const Keyframe& key : deformation.keyframes) size += size_of(key.pose);
  }
  return size;
}

}  // namespace

void check_scene(const Scene& scene) {
  check_count("layers", scene.layers.size(), kMaxLayers);
  if (scene.edited >= scene.layers.size()) fail("the edited layer does not exist");
  check_range("the frame rate", scene.animation.frames_per_second, kMinFrameRate, kMaxFrameRate);
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    try {
      check_texts(layer);
      check_point("the placement", layer.placement(0));
      check_range("the scale of the placement", std::abs(layer.placement.factor),
                  kMinPlacementScale, kMaxPlacementScale);
      if (layer.image && layer.image->width > 0)
        for (const int side : {layer.image->width, layer.image->height})
          check_range("the picture's size", side, 1, kMaxImageSide);
      if (const Clip* clip = clip_of(layer)) check_clip(*clip);
      check_handles(layer.deformation);
      check_paint_and_outline(layer.deformation);
      const Method& method = method_named(layer.deformation.method);
      check_parameters(method, layer.deformation.parameters);
      for (const auto& [id, values] : layer.deformation.other_parameters)
        check_parameters(method_named(id), values);
      check_keyframes(layer.deformation);
    } catch (const Error& error) {
      if (scene.layers.size() == 1) throw;
      throw Error(error.kind(), numbered("layer", i) + ": " + error.what(), error.where());
    }
  }
  check_attachments(scene);
  // Unknown keys may be large and deeply nested. Their size is known only after writing the text.
  if (has_extras(scene))
    scene_from_json(json_of(scene), "the scene");
  else if (largest_size(scene) > budget().scene / 4)
    check_budget(&Budget::scene, static_cast<double>(json_of(scene).size()), "the scene has");
}

void check_coordinates(const Deformation& deformation) {
  const auto check_points = [](const std::string& what, const Points& points) {
    for (const Complex& z : points) check_point(what, z);
  };
  for (const Points& segment : deformation.rest.segments) check_points("the cage", segment);
  for (const Points& segment : deformation.pose.segments) check_points("the posed cage", segment);
  for (size_t i = 0; i < deformation.pins.size(); ++i)
    check_points(numbered("pin", i), {deformation.pins[i].rest, deformation.pins[i].pose});
  for (size_t i = 0; i < deformation.strokes.size(); ++i) {
    check_points(numbered("stroke", i), deformation.strokes[i].rest);
    check_points(numbered("stroke", i), deformation.strokes[i].pose);
  }
  check_points("the outline", deformation.outline);
}

}  // namespace holomorph
