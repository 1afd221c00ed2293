// Positions are compared exactly: a point that was never posed has the same numbers in both shapes.
#include "edit/edits/rest_edits.h"

#include "scene/keyframes.h"

namespace holomorph {
namespace {

bool is_whole_segment_at_rest(const Cage& rest, const Cage& pose, Index segment) {
  return rest.segments[segment] == pose.segments[segment] &&
         rest.end_vertex(segment) == pose.end_vertex(segment);
}

}  // namespace

bool differs_at_rest(const Deformation& a, const Deformation& b) {
  if (a.rest != b.rest || a.pins.size() != b.pins.size() || a.strokes.size() != b.strokes.size())
    return true;
  for (size_t i = 0; i < a.pins.size(); ++i)
    if (a.pins[i].rest != b.pins[i].rest) return true;
  for (size_t i = 0; i < a.strokes.size(); ++i)
    if (a.strokes[i].rest != b.strokes[i].rest) return true;
  return false;
}

Pose pose_following_rest(const Deformation& before, const Deformation& after, Pose pose) {
  if (!fits(before, pose) || before.rest.size() != after.rest.size()) return pose;
  const Cage posed = pose.cage;
  for (Index i = 0; i < before.rest.size(); ++i) {
    const Points &was = before.rest.segments[i], &is = after.rest.segments[i];
    Points& now = pose.cage.segments[i];
    if (is_whole_segment_at_rest(before.rest, posed, i)) {
      now = is;
    } else {
      // The vertex can follow alone. The other points have a counterpart if the degrees agree.
      const size_t points = was.size() == is.size() && was.size() == now.size() ? now.size() : 1;
      for (size_t m = 0; m < points; ++m)
        if (now[m] == was[m]) now[m] = is[m];
    }
  }
  for (size_t i = 0; i < pose.pins.size() && i < after.pins.size(); ++i)
    if (pose.pins[i].position == before.pins[i].rest) pose.pins[i].position = after.pins[i].rest;
  for (size_t i = 0; i < pose.strokes.size() && i < after.strokes.size(); ++i)
    if (pose.strokes[i] == before.strokes[i].rest) pose.strokes[i] = after.strokes[i].rest;
  return pose;
}

Deformation with_poses_following_rest(const Deformation& before, Deformation after) {
  if (!differs_at_rest(before, after)) return after;
  for (Keyframe& key : after.keyframes)
    if (fits(after, key.pose)) key.pose = pose_following_rest(before, after, std::move(key.pose));
  const Pose pose = pose_following_rest(before, after, whole_pose_of(after));
  return fits(after, pose) ? posed_as(std::move(after), pose) : after;
}

}  // namespace holomorph
