// Rest and pose have the same segments; every structural edit is made in both.
#include "edit/edits/edits.h"

#include <algorithm>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/mesh/mesher.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/displacement.h"
#include "scene/keyframes.h"

namespace holomorph {

const Cage& cage_of(const Scene& scene, Posture posture) {
  return posture == Posture::rest ? scene.rest : scene.pose;
}

namespace {

Cage& cage_of(Scene& scene, Posture posture) {
  return posture == Posture::rest ? scene.rest : scene.pose;
}

/// A stroke's points, to read in a const scene and to change in another.
template <class AnyScene>
auto& curve(AnyScene& scene, Index stroke, Posture posture) {
  auto& found = scene.strokes[static_cast<size_t>(stroke)];
  return posture == Posture::rest ? found.rest : found.pose;
}

/// The place of a pin or control point, to read in a const scene and to change in another.
template <class AnyScene>
auto& place(AnyScene& scene, Handle handle, Posture posture) {
  if (handle.kind == Handle::Kind::pin)
    return posture == Posture::rest ? scene.pins[handle.index].rest : scene.pins[handle.index].pose;
  return cage_of(scene, posture).segments[handle.index][handle.control];
}

}  // namespace

const Points& curve_of(const Scene& scene, Index stroke, Posture posture) {
  return curve(scene, stroke, posture);
}

Complex position_of(const Scene& scene, Handle handle, Posture posture) {
  if (handle.kind == Handle::Kind::stroke) {
    const Polyline line(without_repeats(curve_of(scene, handle.index, posture)), false);
    return line.at(0.5 * line.length());
  }
  return place(scene, handle, posture);
}

bool exists(const Scene& scene, Handle handle, Posture posture) {
  if (handle.kind == Handle::Kind::pin)
    return method_named(scene.method).uses_pins &&
           handle.index < static_cast<Index>(scene.pins.size());
  if (handle.kind == Handle::Kind::stroke)
    return method_named(scene.method).uses_strokes &&
           handle.index < static_cast<Index>(scene.strokes.size());
  const Cage& cage = cage_of(scene, posture);
  return handle.index < cage.size() && handle.control < cage.degree(handle.index);
}

std::vector<Handle> handles_of(const Scene& scene, Posture posture) {
  std::vector<Handle> handles;
  const Cage& cage = cage_of(scene, posture);
  for (Index i = 0; i < cage.size(); ++i)
    for (int m = 0; m < cage.degree(i); ++m) handles.push_back({Handle::Kind::cage, i, m});
  if (method_named(scene.method).uses_pins)
    for (Index i = 0; i < static_cast<Index>(scene.pins.size()); ++i)
      handles.push_back({Handle::Kind::pin, i, 0});
  if (method_named(scene.method).uses_strokes)
    for (Index i = 0; i < static_cast<Index>(scene.strokes.size()); ++i)
      handles.push_back({Handle::Kind::stroke, i, 0});
  return handles;
}

std::vector<Handle> tangents_beside(const Cage& cage, Handle handle) {
  if (handle.kind != Handle::Kind::cage || handle.control != 0) return {};
  const Index before = (handle.index + cage.size() - 1) % cage.size();
  std::vector<Handle> tangents;
  if (cage.degree(handle.index) > 1) tangents.push_back({Handle::Kind::cage, handle.index, 1});
  if (cage.degree(before) > 1)
    tangents.push_back({Handle::Kind::cage, before, cage.degree(before) - 1});
  return tangents;
}

void shift(Scene& scene, Handle handle, Complex by, Posture posture) {
  if (handle.kind != Handle::Kind::stroke) {
    place(scene, handle, posture) += by;
    return;
  }
  for (Complex& z : curve(scene, handle.index, posture)) z += by;
}

Scene moved(Scene scene, const Selection& selection, Complex by, Posture posture) {
  Displacements all;
  for (const Handle& handle : selection)
    if (exists(scene, handle, posture)) all[handle] = by;
  return displaced(std::move(scene), all, posture);
}

Scene placed(Scene scene, Handle handle, Complex at, Posture posture) {
  const Complex by = at - position_of(scene, handle, posture);
  return moved(std::move(scene), {handle}, by, posture);
}

Complex center_of(const Scene& scene, const Selection& selection, Posture posture) {
  Box box;
  for (const Handle& handle : selection) box.include(position_of(scene, handle, posture));
  return box.center();
}

Scene inserted(Scene scene, Index segment, double t) {
  for_fitting_keys(scene, [&](Pose& pose) { insert_vertex(pose.cage, segment, t); });
  insert_vertex(scene.rest, segment, t);
  insert_vertex(scene.pose, segment, t);
  follow_insertion(scene.corners, segment);
  return scene;
}

Scene erased(Scene scene, const Selection& selection, Refit refit) {
  // From the highest number down, so that the remaining numbers stay valid.
  Index vertices = 0;
  for (const Handle& handle : selection)
    vertices += handle.kind == Handle::Kind::cage && handle.control == 0;
  if (scene.rest.size() - vertices < 3 && vertices > 0)
    throw Error(ErrorKind::bad_input, "a cage keeps at least three points");
  const std::vector<Handle> downwards(selection.rbegin(), selection.rend());
  for (const Handle& handle : downwards) {
    if (handle.kind == Handle::Kind::pin) {
      for_fitting_keys(scene,
                       [&](Pose& pose) { pose.pins.erase(pose.pins.begin() + handle.index); });
      scene.pins.erase(scene.pins.begin() + handle.index);
    } else if (handle.kind == Handle::Kind::stroke) {
      for_fitting_keys(
          scene, [&](Pose& pose) { pose.strokes.erase(pose.strokes.begin() + handle.index); });
      scene.strokes.erase(scene.strokes.begin() + handle.index);
    } else if (handle.control == 0) {
      const double joint = joint_parameter(scene.rest, handle.index);
      const auto corner = std::ranges::find(scene.corners, handle.index, &Corner::vertex);
      for_fitting_keys(scene, [&](Pose& pose) {
        erase_vertex(pose.cage, handle.index, joint, refit);
        if (corner == scene.corners.end() || pose.corners.empty()) return;
        pose.corners.erase(pose.corners.begin() + (corner - scene.corners.begin()));
        if (pose.corners.size() < 3) pose.corners.clear();
      });
      erase_vertex(scene.rest, handle.index, joint, refit);
      erase_vertex(scene.pose, handle.index, joint, refit);
      follow_erasure(scene.corners, handle.index);
    }
  }
  return scene;
}

Scene with_pin(Scene scene, Complex rest, Complex pose, const std::vector<Points>& in_keyframes) {
  if (!method_named(scene.method).uses_pins) scene = with_method(std::move(scene), "pins");
  for (size_t i = 0; i < scene.keyframes.size(); ++i)
    if (Pose& key = scene.keyframes[i].pose; fits(scene, key))
      key.pins.push_back({i < in_keyframes.size() ? in_keyframes[i].front() : pose});
  scene.pins.push_back({rest, pose, {}, {}});
  return scene;
}

bool follows(const Scene& scene, const std::string& id) {
  return scene.method == id ||
         (scene.method == "bounded" &&
          choice(method_named("bounded"), scene.parameters, "reference") == id);
}

Scene with_stroke(Scene scene, Points rest, Points pose, const std::vector<Points>& in_keyframes) {
  if (!follows(scene, "strokes")) scene = with_method(std::move(scene), "strokes");
  for (size_t i = 0; i < scene.keyframes.size(); ++i)
    if (Pose& key = scene.keyframes[i].pose; fits(scene, key))
      key.strokes.push_back(i < in_keyframes.size() ? in_keyframes[i] : pose);
  scene.strokes.push_back({std::move(rest), std::move(pose), {}});
  return scene;
}

Scene redrawn(Scene scene, Index stroke, Points drawn, Posture posture) {
  Points& points = curve(scene, stroke, posture);
  const double kept = std::abs(drawn.front() - points.front()) +
                      std::abs(drawn.back() - points.back()),
               turned = std::abs(drawn.front() - points.back()) +
                        std::abs(drawn.back() - points.front());
  if (turned < kept) std::ranges::reverse(drawn);
  points = std::move(drawn);
  return scene;
}

Points pulled(const Points& curve, bool closed, size_t point, Complex by, double reach) {
  Points points = curve;
  const size_t n = curve.size();
  points[point] += by;
  for (const bool forwards : {true, false}) {
    double distance = 0;
    size_t at = point;
    for (size_t steps = 1; steps < n; ++steps) {
      if (!closed && at == (forwards ? n - 1 : 0)) break;
      const size_t next = (at + (forwards ? 1 : n - 1)) % n;
      distance += std::abs(curve[next] - curve[at]);
      if (distance >= reach) break;
      const double off = distance / reach;
      points[next] += (1 - off * off) * (1 - off * off) * by;
      at = next;
    }
  }
  return points;
}

Scene with_curve(Scene scene, Index stroke, Points drawn, Posture posture) {
  curve(scene, stroke, posture) = std::move(drawn);
  return scene;
}

Scene with_outline(Scene scene, Points outline, std::optional<SurfaceReference> surface) {
  scene.outline = std::move(outline);
  scene.surface = std::move(surface);
  return follows(scene, "outline") ? scene : with_method(std::move(scene), "outline");
}

Scene turned(Scene scene, Index pin, double angle) {
  scene.pins[pin].angle = angle;
  return scene;
}

Scene scaled(Scene scene, Index pin, double factor) {
  Pin& p = scene.pins[pin];
  p.angle = p.angle.value_or(0);
  p.scale = std::clamp(p.scale * factor, kLeastPinScale, kMostPinScale);
  return scene;
}

namespace {

/// Where an inner control point of a posed segment is when that segment is posed as it rests.
Complex rest_control(const Scene& scene, Handle handle) {
  const Points rest = scene.rest.controls(handle.index);
  const int degree = scene.pose.degree(handle.index);
  if (static_cast<int>(rest.size()) - 1 <= degree) return elevated(rest, degree)[handle.control];
  return bezier_point(rest, static_cast<double>(handle.control) / degree);
}

}  // namespace

Scene reset(Scene scene, const Selection& selection) {
  if (selection.empty()) return at_rest(std::move(scene));
  // Vertices first: they take the tangents along that are not selected themselves.
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0) {
      const Complex rest = scene.rest.vertex(handle.index);
      scene = placed(std::move(scene), handle, rest, Posture::pose);
      for (Corner& corner : scene.corners)
        if (corner.vertex == handle.index) corner.pose = {};
    }
  for (const Handle& handle : selection) {
    if (handle.kind == Handle::Kind::pin) {
      Pin& pin = scene.pins[handle.index];
      pin.pose = pin.rest;
      if (pin.angle) pin.angle = 0.0;
      pin.scale = 1;
    } else if (handle.kind == Handle::Kind::stroke) {
      curve(scene, handle.index, Posture::pose) = curve_of(scene, handle.index, Posture::rest);
    } else if (handle.control > 0 && exists(scene, handle, Posture::pose)) {
      place(scene, handle, Posture::pose) = rest_control(scene, handle);
    }
  }
  return scene;
}

Scene baked(Scene scene) {
  Rest rest = rest_of(scene, Precision::full);
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(scene.rest));
  const auto deformer = method_named(scene.method).prepare(rest, nullptr);
  const std::optional<Cage> solved = deformer->solved_cage(pose_of(scene));
  if (!solved)
    throw Error(
        ErrorKind::bad_input,
        "the pins move a finer boundary than the cage's points; switch \"Cage's own points\" on");
  scene.pose = *solved;
  return with_method(std::move(scene), "cage");
}

Scene with_method(Scene scene, const std::string& id) {
  method_named(id);
  if (id == scene.method) return scene;
  if (scene.parameters.empty())
    scene.other_parameters.erase(scene.method);
  else
    scene.other_parameters[scene.method] = std::move(scene.parameters);
  scene.parameters.clear();
  if (auto kept = scene.other_parameters.extract(id)) scene.parameters = std::move(kept.mapped());
  scene.method = id;
  return scene;
}

Scene with_preset(Scene scene, const Preset& preset) {
  for (const Preset& other : method_named(scene.method).presets)
    for (const auto& entry : other.parameters) scene.parameters.erase(entry.first);
  for (const auto& [key, value] : preset.parameters) scene.parameters[key] = value;
  return scene;
}

Scene fold_free(Scene scene) {
  const ParameterSpec& reference = method_named("bounded").parameters[0];
  const auto followed =
      std::ranges::find(reference.options, scene.method, &ParameterSpec::Option::id);
  check(followed != reference.options.end(), "fold_free: a method that can be followed");
  scene = with_method(std::move(scene), "bounded");
  scene.parameters[reference.key] = static_cast<double>(followed - reference.options.begin());
  return scene;
}

CageHit nearest_on_cage(const Cage& cage, Complex z) {
  CageHit best;
  for (Index i = 0; i < cage.size(); ++i) {
    const Points controls = cage.controls(i);
    const int pieces = controls.size() == 2 ? 1 : 32;
    for (int k = 0; k < pieces; ++k) {
      const double t0 = static_cast<double>(k) / pieces, t1 = static_cast<double>(k + 1) / pieces;
      const NearestPoint near =
          nearest_on_segment(bezier_point(controls, t0), bezier_point(controls, t1), z);
      if (near.distance < best.distance)
        best = {i, t0 + near.t * (t1 - t0), near.point, near.distance};
    }
  }
  return best;
}

}  // namespace holomorph
