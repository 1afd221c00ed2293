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
  const Index part = PartFinder(deformation.rest).at(hole.vertex(0));
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (Pose& key = deformation.keyframes[i].pose; fits(deformation, key))
      add_hole(key.cage,
               with_controls(hole, i < in_keyframes.size() ? in_keyframes[i] : Points{}).segments,
               part);
  const Index loop = loops_of_part(deformation.rest, part).end;
  add_hole(deformation.rest, hole.segments, part);
  add_hole(deformation.pose, with_controls(hole, posed).segments, part);
  if (!deformation.loop_extras.empty())
    deformation.loop_extras.insert(deformation.loop_extras.begin() + (loop - 1), Extra{});
  return deformation;
}

namespace {

/// Removes loops from `range.first` to before `range.end` from the rest, the pose and the keyframes
/// by `erase(cage)`.
template <class Erase>
Deformation without_loops(Deformation deformation, LoopRange range, Erase erase) {
  const Loops loops = deformation.rest.loops();
  const Index first = loops.first(range.first), end = loops.end(range.end - 1);
  for_fitting_keys(deformation, [&](Pose& pose) {
    for (Index v = end; v-- > first;) follow_erasure(pose.corners, deformation.corners, v);
    erase(pose.cage);
  });
  for (Index v = end; v-- > first;) follow_erasure(deformation.corners, v);
  erase(deformation.pose);
  erase(deformation.rest);
  if (!deformation.loop_extras.empty()) {
    // If the first loop goes, the next one takes its place without its extras.
    const auto extra = deformation.loop_extras.begin() + std::max<Index>(range.first - 1, 0);
    deformation.loop_extras.erase(extra, extra + (range.end - range.first));
  }
  return deformation;
}

}  // namespace

Deformation without_hole(Deformation deformation, Index loop) {
  return without_loops(std::move(deformation), {loop, loop + 1},
                       [loop](Cage& cage) { erase_hole(cage, loop); });
}

Deformation without_part(Deformation deformation, Index part) {
  const LoopRange range = loops_of_part(deformation.rest, part);
  return without_loops(std::move(deformation), range,
                       [part](Cage& cage) { erase_part(cage, part); });
}

Deformation filled(Deformation deformation, const Selection& selection) {
  std::set<Index> loops;
  for (const Handle& handle : selection)
    if (handle.kind == Handle::Kind::cage)
      loops.insert(deformation.rest.loops().loop_of(handle.index));
  std::erase_if(loops, [&](Index l) { return !deformation.rest.is_hole(l); });
  if (loops.empty())
    for (Index l = 1; l < deformation.rest.loops().count(); ++l)
      if (deformation.rest.is_hole(l)) loops.insert(l);
  for (auto loop = loops.rbegin(); loop != loops.rend(); ++loop)
    deformation = without_hole(std::move(deformation), *loop);
  return deformation;
}

}  // namespace holomorph
