#include "scene/mirror.h"

#include <algorithm>

#include "core/error.h"
#include "core/geometry/polyline.h"

namespace holomorph {
namespace {

size_t counterpart(const Mirror& mirror, const Points& positions, Complex z, const char* what) {
  if (const auto found = mirror.counterpart(positions, z)) return *found;
  throw Error(ErrorKind::bad_input,
              std::string("the pose cannot be mirrored: a ") + what +
                  " has no counterpart on the other side of the cage",
              z);
}

Cage mirrored_cage(const Mirror& mirror, const Cage& rest, const Cage& pose) {
  const Points vertices = vertices_of(rest);
  Cage result;
  result.starts = rest.starts;
  result.parts = rest.parts;
  for (Index e = 0; e < rest.size(); ++e) {
    // The mirrored cage usually runs in the opposite direction. The counterpart of segment e then
    // starts at the counterpart of the vertex where e ends. Two holes may run in either direction.
    const auto start =
        static_cast<Index>(counterpart(mirror, vertices, rest.vertex(e), "cage point"));
    const auto end =
        static_cast<Index>(counterpart(mirror, vertices, rest.end_vertex(e), "cage point"));
    const bool backward = rest.next(end) == start;
    if (!backward && rest.next(start) != end)
      throw Error(ErrorKind::bad_input,
                  "the pose cannot be mirrored: the two sides of the cage do not match",
                  rest.vertex(e));
    Points controls = pose.controls(backward ? end : start);
    if (backward) std::ranges::reverse(controls);
    controls.pop_back();
    result.segments.push_back(mirror(std::move(controls)));
  }
  return result;
}

std::vector<PosePin> mirrored_pins(const Mirror& mirror, const std::vector<Pin>& pins,
                                   const std::vector<PosePin>& posed) {
  Points positions;
  for (const Pin& pin : pins) positions.push_back(pin.rest);
  std::vector<PosePin> result;
  for (const Complex& z : positions) {
    const PosePin& other = posed[counterpart(mirror, positions, z, "pin")];
    result.push_back({mirror(other.position), -other.angle, other.scale, {}});
    if (other.turn) result.back().turn = -*other.turn;
  }
  return result;
}

std::vector<Points> mirrored_strokes(const Mirror& mirror, const std::vector<Stroke>& strokes,
                                     const std::vector<Points>& posed) {
  Points middles;
  for (const Stroke& stroke : strokes) {
    const Polyline line(without_repeats(stroke.rest), false);
    middles.push_back(line.at(0.5 * line.length()));
  }
  std::vector<Points> result;
  for (size_t i = 0; i < strokes.size(); ++i) {
    const size_t other = counterpart(mirror, middles, middles[i], "stroke");
    result.push_back(mirror(posed[other]));
    // If a stroke was drawn in the opposite direction, its start corresponds to the end of its
    // counterpart.
    const Points &rest = strokes[i].rest, &theirs = strokes[other].rest;
    if (std::abs(mirror(theirs.back()) - rest.front()) <
        std::abs(mirror(theirs.front()) - rest.front()))
      std::ranges::reverse(result.back());
  }
  return result;
}

std::vector<PoseCorner> mirrored_corners(const Mirror& mirror, const Deformation& deformation,
                                         const std::vector<PoseCorner>& posed) {
  const Points vertices = vertices_of(deformation.rest);
  const size_t count = posed.size();
  std::vector<PoseCorner> result;
  for (size_t k = 0; k < count; ++k) {
    const Index vertex = static_cast<Index>(counterpart(
        mirror, vertices, deformation.rest.vertex(deformation.corners[k].vertex), "cage point"));
    const auto other = std::ranges::find(deformation.corners, vertex, &Corner::vertex);
    if (other == deformation.corners.end())
      throw Error(ErrorKind::bad_input,
                  "the pose cannot be mirrored: the counterpart of a corner is not a corner",
                  deformation.rest.vertex(vertex));
    const size_t at = static_cast<size_t>(other - deformation.corners.begin());
    // The edge after a corner corresponds to the edge before its counterpart.
    result.push_back(
        {-posed[at].after, -posed[at].before, posed[(at + count - 1) % count].tension});
  }
  return result;
}

}  // namespace

Pose mirrored(const Deformation& deformation, const Pose& pose) {
  check(fits(deformation, pose), "mirrored: the pose fits");
  const Mirror mirror(deformation);
  Pose result = pose;
  result.cage = mirrored_cage(mirror, deformation.rest, pose.cage);
  result.pins = mirrored_pins(mirror, deformation.pins, pose.pins);
  result.strokes = mirrored_strokes(mirror, deformation.strokes, pose.strokes);
  result.corners = mirrored_corners(mirror, deformation, pose.corners);
  return result;
}

}  // namespace holomorph
