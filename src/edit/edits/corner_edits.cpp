// A list of corners is written down by the first edit that needs one.
#include "edit/edits/corner_edits.h"

#include <algorithm>

#include "core/error.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

auto found(const Scene& scene, Index vertex) {
  return std::ranges::find(scene.corners, vertex, &Corner::vertex);
}

/// A scene whose method sets angles, with the corners listed and this one among them.
PoseCorner& corner(Scene& scene, Index vertex) {
  if (!follows(scene, "angles")) scene = with_method(std::move(scene), "angles");
  scene = scene.corners.empty() ? with_all_corners(std::move(scene))
                                : with_corner(std::move(scene), vertex);
  return std::ranges::find(scene.corners, vertex, &Corner::vertex)->pose;
}

}  // namespace

bool is_corner(const Scene& scene, Index vertex) {
  return scene.corners.empty() || found(scene, vertex) != scene.corners.end();
}

PoseCorner corner_at(const Scene& scene, Index vertex) {
  const auto at = found(scene, vertex);
  return at == scene.corners.end() ? PoseCorner{} : at->pose;
}

double corner_opening(const Scene& scene, Index vertex) {
  const PoseCorner pose = corner_at(scene, vertex);
  return signed_area(outline_of(scene.rest)) > 0 ? pose.before - pose.after
                                                 : pose.after - pose.before;
}

Scene with_corner(Scene scene, Index vertex) {
  if (is_corner(scene, vertex)) return scene;
  const auto next = std::ranges::upper_bound(scene.corners, vertex, {}, &Corner::vertex);
  const size_t at = static_cast<size_t>(next - scene.corners.begin()), n = scene.corners.size();
  const Corner &before = scene.corners[(at + n - 1) % n], &after = scene.corners[at % n];
  // The share of the way, by the rest's vertices.
  const auto way = [&](Index from, Index to) {
    double length = 0;
    for (Index v = from; v != to; v = (v + 1) % scene.rest.size())
      length += std::abs(scene.rest.vertex(v + 1) - scene.rest.vertex(v));
    return length;
  };
  const double share =
      way(before.vertex, vertex) / (way(before.vertex, vertex) + way(vertex, after.vertex));
  const auto between = [&](const PoseCorner& from, const PoseCorner& to) {
    const double turn = (1 - share) * from.after + share * to.before;
    return PoseCorner{turn, turn, from.tension};
  };
  for_fitting_keys(scene, [&](Pose& pose) {
    if (pose.corners.empty()) return;
    pose.corners.insert(pose.corners.begin() + static_cast<long>(at),
                        between(pose.corners[(at + n - 1) % n], pose.corners[at % n]));
  });
  scene.corners.insert(scene.corners.begin() + static_cast<long>(at),
                       Corner{vertex, between(before.pose, after.pose), {}});
  return scene;
}

Scene without_corner(Scene scene, Index vertex) {
  if (scene.corners.empty()) scene = with_all_corners(std::move(scene));
  if (scene.corners.size() <= 3)
    throw Error(ErrorKind::bad_input, "three corners stay: fewer have no angles to set");
  if (const auto at = found(scene, vertex); at != scene.corners.end()) {
    const long number = at - scene.corners.begin();
    for_fitting_keys(scene, [&](Pose& pose) {
      if (!pose.corners.empty()) pose.corners.erase(pose.corners.begin() + number);
    });
    scene.corners.erase(scene.corners.begin() + number);
  }
  return scene;
}

Scene with_all_corners(Scene scene) {
  if (scene.corners.empty())
    for (Index v = 0; v < scene.rest.size(); ++v) scene.corners.push_back({v});
  for (Index v = 0; v < scene.rest.size(); ++v) scene = with_corner(std::move(scene), v);
  return scene;
}

Scene corner_turned(Scene scene, Index vertex, double by) {
  PoseCorner& pose = corner(scene, vertex);
  pose.before += by;
  pose.after += by;
  return scene;
}

Scene corner_opened(Scene scene, Index vertex, double by) {
  PoseCorner& pose = corner(scene, vertex);
  const double way = signed_area(outline_of(scene.rest)) > 0 ? by : -by;
  pose.before += way;
  pose.after -= way;
  return scene;
}

Index corner_before(const Scene& scene, Index segment) {
  if (scene.corners.empty()) return segment;
  const auto next = std::ranges::upper_bound(scene.corners, segment, {}, &Corner::vertex);
  return next == scene.corners.begin() ? scene.corners.back().vertex : std::prev(next)->vertex;
}

Scene with_tension(Scene scene, Index vertex, double tension) {
  corner(scene, vertex).tension = std::clamp(tension, 0.0, 1.0);
  return scene;
}

void follow_insertion(std::vector<Corner>& corners, Index segment) {
  for (Corner& corner : corners) corner.vertex += corner.vertex > segment;
}

void follow_erasure(std::vector<Corner>& corners, Index vertex) {
  std::erase_if(corners, [&](const Corner& corner) { return corner.vertex == vertex; });
  for (Corner& corner : corners) corner.vertex -= corner.vertex > vertex;
  if (corners.size() < 3) corners.clear();
}

}  // namespace holomorph
