#include "edit/edits/hole_edits.h"

#include "core/error.h"
#include "edit/edits/corner_edits.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

/// The hole with these control points. Images in a mesh are rounded; points that stay must not
/// move.
Cage with_controls(Cage hole, const Points& controls) {
  check(controls.empty() || static_cast<Index>(controls.size()) == hole.control_count(),
        "with_hole: one position for each control point");
  constexpr double kRounding = 1e-9;  // of the size
  const double least = kRounding * box_of(controls_of(hole)).diagonal();
  size_t i = 0;
  for (Points& segment : hole.segments)
    for (Complex& z : segment) {
      if (!controls.empty() && std::abs(controls[i] - z) > least) z = controls[i];
      ++i;
    }
  return hole;
}

}  // namespace

Deformation with_hole(Deformation deformation, const Cage& hole, const Points& posed,
                      const std::vector<Points>& in_keyframes) {
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (Pose& key = deformation.keyframes[i].pose; fits(deformation, key))
      add_hole(key.cage,
               with_controls(hole, i < in_keyframes.size() ? in_keyframes[i] : Points{}).segments);
  add_hole(deformation.rest, hole.segments);
  add_hole(deformation.pose, with_controls(hole, posed).segments);
  if (!deformation.hole_extras.empty()) deformation.hole_extras.emplace_back();
  return deformation;
}

Deformation without_hole(Deformation deformation, Index loop) {
  const Loops loops = deformation.rest.loops();
  for_fitting_keys(deformation, [&](Pose& pose) {
    for (Index v = loops.end(loop); v-- > loops.first(loop);)
      follow_erasure(pose.corners, deformation.corners, v);
    erase_hole(pose.cage, loop);
  });
  for (Index v = loops.end(loop); v-- > loops.first(loop);) follow_erasure(deformation.corners, v);
  erase_hole(deformation.rest, loop);
  erase_hole(deformation.pose, loop);
  if (!deformation.hole_extras.empty())
    deformation.hole_extras.erase(deformation.hole_extras.begin() + (loop - 1));
  return deformation;
}

Deformation filled(Deformation deformation, const Selection& selection) {
  std::set<Index> loops;
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage)
      loops.insert(deformation.rest.loops().loop_of(handle.index));
  loops.erase(0);
  if (loops.empty())
    for (Index l = 1; l < deformation.rest.loops().count(); ++l) loops.insert(l);
  for (auto loop = loops.rbegin(); loop != loops.rend(); ++loop)
    deformation = without_hole(std::move(deformation), *loop);
  return deformation;
}

}  // namespace holomorph
