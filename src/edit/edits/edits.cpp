// The rest shape, the pose and the keyframes have the same structure, so structural edits change
// all of them.
#include "edit/edits/edits.h"

#include <algorithm>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/maps/deformer.h"
#include "core/maps/held_disk.h"
#include "core/mesh/mesher.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/displacement.h"
#include "edit/edits/hole_edits.h"
#include "edit/edits/method_edits.h"
#include "edit/edits/rest_edits.h"
#include "scene/keyframes.h"

namespace holomorph {

std::string kind_of(const Selection& handles) {
  const auto all = [&](Handle::Kind kind) {
    return std::ranges::all_of(handles, [&](const Handle& h) { return h.kind == kind; });
  };
  return all(Handle::Kind::pin) ? "pin" : all(Handle::Kind::stroke) ? "stroke" : "point";
}

const Cage& cage_of(const Deformation& deformation, EditMode mode) {
  return mode == EditMode::rest ? deformation.rest : deformation.pose;
}

namespace {

/// The points of a stroke. The reference is const if the deformation is const.
template <class AnyDeformation>
auto& curve(AnyDeformation& deformation, Index stroke, EditMode mode) {
  auto& found = deformation.strokes[static_cast<size_t>(stroke)];
  return mode == EditMode::rest ? found.rest : found.pose;
}

/// The position of a pin or control point. The reference is const if the deformation is const.
template <class AnyDeformation>
auto& point_of(AnyDeformation& deformation, Handle handle, EditMode mode) {
  if (handle.kind == Handle::Kind::pin)
    return mode == EditMode::rest ? deformation.pins[handle.index].rest
                                  : deformation.pins[handle.index].pose;
  auto& cage = mode == EditMode::rest ? deformation.rest : deformation.pose;
  return cage.segments[handle.index][handle.control];
}

}  // namespace

const Points& curve_of(const Deformation& deformation, Index stroke, EditMode mode) {
  return curve(deformation, stroke, mode);
}

Complex position_of(const Deformation& deformation, Handle handle, EditMode mode) {
  if (handle.kind == Handle::Kind::stroke) {
    const Polyline line(without_repeats(curve_of(deformation, handle.index, mode)), false);
    return line.at(0.5 * line.length());
  }
  return point_of(deformation, handle, mode);
}

bool has_cage_handles(const Deformation& deformation, EditMode mode) {
  return mode == EditMode::rest || deformation.pins.empty() ||
         !method_named(deformation.method).pins_replace_cage;
}

bool exists(const Deformation& deformation, Handle handle, EditMode mode) {
  if (handle.kind == Handle::Kind::pin)
    return method_named(deformation.method).uses_pins &&
           handle.index < static_cast<Index>(deformation.pins.size());
  if (handle.kind == Handle::Kind::stroke)
    return method_named(deformation.method).uses_strokes &&
           handle.index < static_cast<Index>(deformation.strokes.size());
  const Cage& cage = cage_of(deformation, mode);
  return has_cage_handles(deformation, mode) && handle.index < cage.size() &&
         handle.control < cage.degree(handle.index);
}

std::vector<Handle> handles_of(const Deformation& deformation, EditMode mode) {
  std::vector<Handle> handles;
  const Cage& cage = cage_of(deformation, mode);
  for (Index i = 0; i < cage.size() && has_cage_handles(deformation, mode); ++i)
    for (int m = 0; m < cage.degree(i); ++m) handles.push_back({Handle::Kind::cage, i, m});
  if (method_named(deformation.method).uses_pins)
    for (Index i = 0; i < static_cast<Index>(deformation.pins.size()); ++i)
      handles.push_back({Handle::Kind::pin, i, 0});
  if (method_named(deformation.method).uses_strokes)
    for (Index i = 0; i < static_cast<Index>(deformation.strokes.size()); ++i)
      handles.push_back({Handle::Kind::stroke, i, 0});
  return handles;
}

std::vector<Handle> adjacent_tangents(const Cage& cage, Handle handle) {
  if (handle.kind != Handle::Kind::cage || handle.control != 0) return {};
  const Index before = cage.before(handle.index);
  std::vector<Handle> tangents;
  if (cage.degree(handle.index) > 1) tangents.push_back({Handle::Kind::cage, handle.index, 1});
  if (cage.degree(before) > 1)
    tangents.push_back({Handle::Kind::cage, before, cage.degree(before) - 1});
  return tangents;
}

void shift(Deformation& deformation, Handle handle, Complex by, EditMode mode) {
  if (handle.kind != Handle::Kind::stroke) {
    point_of(deformation, handle, mode) += by;
    return;
  }
  for (Complex& z : curve(deformation, handle.index, mode)) z += by;
}

Deformation moved(Deformation deformation, const Selection& selection, Complex by, EditMode mode) {
  Displacements all;
  for (const Handle& handle : selection)
    if (exists(deformation, handle, mode)) all[handle] = by;
  return displaced(std::move(deformation), all, mode);
}

Deformation placed(Deformation deformation, Handle handle, Complex at, EditMode mode) {
  const Complex by = at - position_of(deformation, handle, mode);
  return moved(std::move(deformation), {handle}, by, mode);
}

Complex center_of(const Deformation& deformation, const Selection& selection, EditMode mode) {
  Box box;
  for (const Handle& handle : selection) box.include(position_of(deformation, handle, mode));
  return box.center();
}

Deformation inserted(Deformation deformation, Index segment, double t) {
  for_fitting_keys(deformation, [&](Pose& pose) { insert_vertex(pose.cage, segment, t); });
  insert_vertex(deformation.rest, segment, t);
  insert_vertex(deformation.pose, segment, t);
  follow_insertion(deformation.corners, segment);
  return deformation;
}

Deformation erased(Deformation deformation, const Selection& selection, Refit refit) {
  const Cage rest = deformation.rest;
  const Loops loops = rest.loops();
  std::vector<Index> left;  // vertices that remain in each loop
  for (Index l = 0; l < loops.count(); ++l) left.push_back(loops.length(l));
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0)
      --left[static_cast<size_t>(loops.loop_of(handle.index))];
  Index emptied = 0;  // parts that are deleted as a whole
  for (Index part = 0; part < rest.part_count(); ++part)
    emptied += left[static_cast<size_t>(loops_of_part(rest, part).first)] < 3;
  if (deformation.has_cage() && emptied == rest.part_count() &&
      std::ranges::any_of(selection, [](const Handle& handle) {
        return handle.kind == Handle::Kind::cage && handle.control == 0;
      }))
    throw Error(ErrorKind::bad_input,
                "a cage needs at least three points; select fewer points to delete");
  // Handles are deleted in decreasing order, which keeps the remaining indices valid.
  std::set<Index> erased_loops;
  const std::vector<Handle> downwards(selection.rbegin(), selection.rend());
  for (const Handle& handle : downwards) {
    if (handle.kind == Handle::Kind::cage) {
      // A hole or a part with fewer than three points is deleted as a whole.
      const Index loop = loops.loop_of(handle.index);
      if (left[static_cast<size_t>(loop)] < 3) {
        if (!erased_loops.insert(loop).second) continue;
        if (rest.is_hole(loop)) {
          deformation = without_hole(std::move(deformation), loop);
        } else {
          Index part = 0;
          while (loops_of_part(rest, part).first != loop) ++part;
          deformation = without_part(std::move(deformation), part);
        }
        continue;
      }
    }
    if (handle.kind == Handle::Kind::pin) {
      for_fitting_keys(deformation,
                       [&](Pose& pose) { pose.pins.erase(pose.pins.begin() + handle.index); });
      deformation.pins.erase(deformation.pins.begin() + handle.index);
    } else if (handle.kind == Handle::Kind::stroke) {
      for_fitting_keys(deformation, [&](Pose& pose) {
        pose.strokes.erase(pose.strokes.begin() + handle.index);
      });
      deformation.strokes.erase(deformation.strokes.begin() + handle.index);
    } else if (handle.control == 0) {
      const double joint = joint_parameter(deformation.rest, handle.index);
      for_fitting_keys(deformation, [&](Pose& pose) {
        erase_vertex(pose.cage, handle.index, joint, refit);
        follow_erasure(pose.corners, deformation.corners, handle.index);
      });
      erase_vertex(deformation.rest, handle.index, joint, refit);
      erase_vertex(deformation.pose, handle.index, joint, refit);
      follow_erasure(deformation.corners, handle.index);
    }
  }
  return deformation;
}

Deformation with_pin(Deformation deformation, Complex rest, Complex pose,
                     const std::vector<Points>& in_keyframes) {
  if (!method_named(deformation.method).uses_pins) {
    // The puppet has no use for cage points, so they must not have moved.
    const bool at_rest = deformation.pose == deformation.rest &&
                         std::ranges::all_of(deformation.keyframes, [&](const Keyframe& key) {
                           return key.pose.cage == deformation.rest;
                         });
    deformation =
        with_method_for(std::move(deformation), at_rest ? MethodUse::puppet : MethodUse::pins);
  }
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (Pose& key = deformation.keyframes[i].pose; fits(deformation, key))
      key.pins.push_back({i < in_keyframes.size() ? in_keyframes[i].front() : pose});
  deformation.pins.push_back({rest, pose, {}, {}});
  return deformation;
}

Deformation with_stroke(Deformation deformation, Points rest, Points pose,
                        const std::vector<Points>& in_keyframes) {
  if (!has_method_for(deformation, MethodUse::strokes))
    deformation = with_method_for(std::move(deformation), MethodUse::strokes);
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (Pose& key = deformation.keyframes[i].pose; fits(deformation, key))
      key.strokes.push_back(i < in_keyframes.size() ? in_keyframes[i] : pose);
  deformation.strokes.push_back({std::move(rest), std::move(pose), {}});
  return deformation;
}

Deformation redrawn(Deformation deformation, Index stroke, Points drawn, EditMode mode) {
  const Points& points = curve(deformation, stroke, mode);
  const double kept = std::abs(drawn.front() - points.front()) +
                      std::abs(drawn.back() - points.back()),
               turned = std::abs(drawn.front() - points.back()) +
                        std::abs(drawn.back() - points.front());
  if (turned < kept) std::ranges::reverse(drawn);
  return with_curve(std::move(deformation), stroke, std::move(drawn), mode);
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

Deformation with_curve(Deformation deformation, Index stroke, Points drawn, EditMode mode) {
  return edited_in(mode, std::move(deformation),
                   [&](Deformation& edited) { curve(edited, stroke, mode) = std::move(drawn); });
}

Deformation with_outline(Deformation deformation, Points outline,
                         std::optional<SurfaceReference> surface) {
  deformation.outline = std::move(outline);
  deformation.surface = std::move(surface);
  return has_method_for(deformation, MethodUse::outline)
             ? deformation
             : with_method_for(std::move(deformation), MethodUse::outline);
}

Deformation turned(Deformation deformation, Index pin, double angle) {
  deformation.pins[pin].angle = angle;
  return deformation;
}

Deformation scaled(Deformation deformation, Index pin, double factor) {
  Pin& p = deformation.pins[pin];
  p.angle = p.angle.value_or(0);
  p.scale = std::clamp(p.scale * factor, kMinPinScale, kMaxPinScale);
  return deformation;
}

std::optional<double> held_radius(const Deformation& deformation, Index pin,
                                  const PreparedMap* prepared) {
  const Pin& p = deformation.pins[pin];
  const Method& method = followed_method(method_named(deformation.method), deformation.parameters);
  if (!p.angle || !method.holds_disks || !deformation.has_cage()) return {};
  if (!p.radius && prepared && prepared->method == deformation.method &&
      static_cast<size_t>(pin) < prepared->rest.pins.size())
    if (const auto usual = prepared->deformer->usual_radius(static_cast<size_t>(pin))) return usual;
  return held_radius(deformation.rest, {p.rest, true, p.radius});
}

Deformation with_held_radius(Deformation deformation, Index pin, double radius) {
  const double size = box_of(outline_of(deformation.rest).points).diagonal();
  deformation.pins[pin].radius =
      std::clamp(radius, std::max(kMinPinRadius, 1e-3 * size), std::min(kMaxPinRadius, size));
  return deformation;
}

namespace {

/// The position of an inner control point of a posed segment when the segment has its rest shape.
Complex rest_control(const Deformation& deformation, Handle handle) {
  const Points rest = deformation.rest.controls(handle.index);
  const int degree = deformation.pose.degree(handle.index);
  if (static_cast<int>(rest.size()) - 1 <= degree) return elevated(rest, degree)[handle.control];
  return bezier_point(rest, static_cast<double>(handle.control) / degree);
}

}  // namespace

Deformation reset(Deformation deformation, const Selection& selection) {
  if (selection.empty()) return at_rest(std::move(deformation));
  // Vertices are reset first because unselected tangents move with them.
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage && handle.control == 0) {
      const Complex rest = deformation.rest.vertex(handle.index);
      deformation = placed(std::move(deformation), handle, rest, EditMode::pose);
      for (Corner& corner : deformation.corners)
        if (corner.vertex == handle.index) corner.pose = {};
    }
  for (const Handle& handle : selection) {
    if (handle.kind == Handle::Kind::pin) {
      Pin& pin = deformation.pins[handle.index];
      pin.pose = pin.rest;
      if (pin.angle) pin.angle = 0.0;
      if (pin.turn) pin.turn = 0.0;
      pin.scale = 1;
    } else if (handle.kind == Handle::Kind::stroke) {
      curve(deformation, handle.index, EditMode::pose) =
          curve_of(deformation, handle.index, EditMode::rest);
    } else if (handle.control > 0 && exists(deformation, handle, EditMode::pose)) {
      point_of(deformation, handle, EditMode::pose) = rest_control(deformation, handle);
    }
  }
  return deformation;
}

Deformation baked(Deformation deformation) {
  Rest rest = rest_of(deformation, Precision::full);
  rest.mesh = std::make_shared<const Mesh>(domain_mesh(deformation.rest));
  const auto deformer = method_named(deformation.method).prepare(rest, nullptr);
  const std::optional<Cage> solved = deformer->solved_cage(pose_of(deformation));
  if (!solved)
    throw Error(
        ErrorKind::bad_input,
        "the pins act on a finer boundary than the cage's points; turn on \"Cage's own points\"");
  deformation.pose = *solved;
  return with_method_for(std::move(deformation), MethodUse::cage);
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
