// The list of corners is empty until an edit needs it; an empty list means all vertices.
#include "edit/edits/corner_edits.h"

#include <algorithm>

#include "core/error.h"
#include "edit/edits/method_edits.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

auto found(const Deformation& deformation, Index vertex) {
  return std::ranges::find(deformation.corners, vertex, &Corner::vertex);
}

/// Switches to a method for corners if needed, fills the list of corners if it is empty, makes the
/// vertex a corner, and returns the pose of that corner.
PoseCorner& corner(Deformation& deformation, Index vertex) {
  if (!has_method_for(deformation, MethodUse::corners))
    deformation = with_method_for(std::move(deformation), MethodUse::corners);
  check(vertex >= 0 && vertex < deformation.rest.size(), "corner: the vertex is not in the cage");
  deformation = deformation.corners.empty() ? with_all_corners(std::move(deformation))
                                            : with_corner(std::move(deformation), vertex);
  return std::ranges::find(deformation.corners, vertex, &Corner::vertex)->pose;
}

}  // namespace

bool is_corner(const Deformation& deformation, Index vertex) {
  return deformation.corners.empty() || found(deformation, vertex) != deformation.corners.end();
}

PoseCorner corner_at(const Deformation& deformation, Index vertex) {
  const auto at = found(deformation, vertex);
  return at == deformation.corners.end() ? PoseCorner{} : at->pose;
}

double corner_opening(const Deformation& deformation, Index vertex) {
  const PoseCorner pose = corner_at(deformation, vertex);
  return signed_area(outline_of(deformation.rest)) > 0 ? pose.before - pose.after
                                                       : pose.after - pose.before;
}

Deformation with_corner(Deformation deformation, Index vertex) {
  if (is_corner(deformation, vertex)) return deformation;
  const auto next = std::ranges::upper_bound(deformation.corners, vertex, {}, &Corner::vertex);
  const size_t at = static_cast<size_t>(next - deformation.corners.begin()),
               n = deformation.corners.size();
  const Corner &before = deformation.corners[(at + n - 1) % n],
               &after = deformation.corners[at % n];
  // The position of the vertex between the corners before and after it, by arc length at rest.
  const auto way = [&](Index from, Index to) {
    double length = 0;
    for (Index v = from; v != to; v = (v + 1) % deformation.rest.size())
      length += std::abs(deformation.rest.end_vertex(v) - deformation.rest.vertex(v));
    return length;
  };
  const double fraction =
      way(before.vertex, vertex) / (way(before.vertex, vertex) + way(vertex, after.vertex));
  const auto between = [&](const PoseCorner& from, const PoseCorner& to) {
    const double turn = (1 - fraction) * from.after + fraction * to.before;
    return PoseCorner{turn, turn, from.tension};
  };
  for_fitting_keys(deformation, [&](Pose& pose) {
    if (pose.corners.empty()) return;
    pose.corners.insert(pose.corners.begin() + static_cast<long>(at),
                        between(pose.corners[(at + n - 1) % n], pose.corners[at % n]));
  });
  deformation.corners.insert(deformation.corners.begin() + static_cast<long>(at),
                             Corner{vertex, between(before.pose, after.pose), {}});
  return deformation;
}

Deformation without_corner(Deformation deformation, Index vertex) {
  if (deformation.corners.empty()) deformation = with_all_corners(std::move(deformation));
  if (deformation.corners.size() <= 3)
    throw Error(ErrorKind::bad_input,
                "the method needs at least three corners; make another point a corner first");
  if (const auto at = found(deformation, vertex); at != deformation.corners.end()) {
    const long number = at - deformation.corners.begin();
    for_fitting_keys(deformation, [&](Pose& pose) {
      if (!pose.corners.empty()) pose.corners.erase(pose.corners.begin() + number);
    });
    deformation.corners.erase(deformation.corners.begin() + number);
  }
  return deformation;
}

Deformation with_all_corners(Deformation deformation) {
  if (deformation.corners.empty())
    for (Index v = 0; v < deformation.rest.size(); ++v) deformation.corners.push_back({v});
  for (Index v = 0; v < deformation.rest.size(); ++v)
    deformation = with_corner(std::move(deformation), v);
  return deformation;
}

Deformation with_corner_pose(Deformation deformation, Index vertex, const PoseCorner& pose) {
  corner(deformation, vertex) = pose;
  return deformation;
}

Deformation corner_turned(Deformation deformation, Index vertex, double by) {
  PoseCorner& pose = corner(deformation, vertex);
  pose.before += by;
  pose.after += by;
  return deformation;
}

Deformation corner_opened(Deformation deformation, Index vertex, double by) {
  PoseCorner& pose = corner(deformation, vertex);
  const double way = signed_area(outline_of(deformation.rest)) > 0 ? by : -by;
  pose.before += way;
  pose.after -= way;
  return deformation;
}

Index corner_before(const Deformation& deformation, Index segment) {
  if (deformation.corners.empty()) return segment;
  const auto next = std::ranges::upper_bound(deformation.corners, segment, {}, &Corner::vertex);
  return next == deformation.corners.begin() ? deformation.corners.back().vertex
                                             : std::prev(next)->vertex;
}

Deformation with_tension(Deformation deformation, Index vertex, double tension) {
  corner(deformation, vertex).tension = std::clamp(tension, 0.0, 1.0);
  return deformation;
}

void follow_insertion(std::vector<Corner>& corners, Index segment) {
  for (Corner& corner : corners) corner.vertex += corner.vertex > segment;
}

void follow_erasure(std::vector<Corner>& corners, Index vertex) {
  std::erase_if(corners, [&](const Corner& corner) { return corner.vertex == vertex; });
  for (Corner& corner : corners) corner.vertex -= corner.vertex > vertex;
  if (corners.size() < 3) corners.clear();
}

void follow_erasure(std::vector<PoseCorner>& pose, const std::vector<Corner>& corners,
                    Index vertex) {
  const auto corner = std::ranges::find(corners, vertex, &Corner::vertex);
  if (corner == corners.end() || pose.empty()) return;
  pose.erase(pose.begin() + (corner - corners.begin()));
  if (pose.size() < 3) pose.clear();
}

}  // namespace holomorph
