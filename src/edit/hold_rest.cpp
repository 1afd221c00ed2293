// Distances are measured along the edges of the mesh, so that two limbs that are close to each
// other count as far apart.
#include "edit/hold_rest.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/edge_distances.h"
#include "edit/edits/edits.h"
#include "edit/frame.h"
#include "edit/picking.h"

namespace holomorph {
namespace {

constexpr double kFar = 0.45;    ///< least distance, relative to that of the farthest point
constexpr double kAsFar = 0.85;  ///< points this far relative to the farthest belong to its part

int nearest_vertex(const Mesh& mesh, Complex z) {
  const auto found = std::ranges::min_element(
      mesh.vertices, {}, [&](const Complex& vertex) { return std::abs(vertex - z); });
  return static_cast<int>(found - mesh.vertices.begin());
}

std::vector<double> distances_from(const EdgeDistances& edges, int vertex) {
  return edges.from(std::vector{EdgeDistances::Source{vertex}}).distance;
}

}  // namespace

Points far_points(const Mesh& mesh, std::span<const Complex> from, size_t most) {
  const EdgeDistances edges(mesh);
  std::vector<EdgeDistances::Source> held, boundary;
  for (const Complex& z : from) held.push_back({nearest_vertex(mesh, z)});
  for (const int v : mesh.boundary) boundary.push_back({v});
  std::vector<double> distance = edges.from(held).distance;
  for (double& away : distance)
    if (!std::isfinite(away)) away = 0;  // other parts of the picture follow this one
  const std::vector<double> inside = edges.from(boundary).distance;
  Points far;
  double first = 0;
  while (far.size() < most) {
    const double farthest = std::ranges::max(distance);
    if (far.empty()) first = farthest;
    if (!(farthest > 0) || !std::isfinite(farthest) || farthest < kFar * first) break;
    // Of the points that are about as far, take the one that lies deepest inside, near the
    // farthest one.
    const auto tip = static_cast<int>(std::ranges::max_element(distance) - distance.begin());
    const std::vector<double> from_tip = distances_from(edges, tip);
    size_t best = static_cast<size_t>(tip);
    for (size_t v = 0; v < distance.size(); ++v)
      if (distance[v] >= kAsFar * farthest && from_tip[v] <= (1 - kAsFar) * farthest &&
          inside[v] > inside[best])
        best = v;
    far.push_back(mesh.vertices[best]);
    std::ranges::transform(distance, distances_from(edges, static_cast<int>(best)),
                           distance.begin(), [](double a, double b) { return std::min(a, b); });
  }
  return far;
}

bool can_hold_rest(const Workspace& w) {
  const Deformation& deformation = w.shown.deformation();
  if (can_choose_frame(w)) return can_hold_beyond(w) && w.mode == EditMode::pose;
  return deformation.has_cage() && deformation.pins.size() == 1 && w.map().has_map() &&
         w.mode == EditMode::pose && method_named(deformation.method).uses_pins;
}

void hold_rest(Workspace& w) {
  if (can_choose_frame(w)) {
    if (w.require_open_layer()) hold_beyond(w);
    return;
  }
  if (!w.require_open_layer() || !w.require_keyframe_maps()) return;
  const Deformation before = w.shown.deformation();
  const Points far = far_points(*w.map().prepared()->mesh, std::vector{before.pins[0].rest});
  const std::vector<Points> in_keyframes = w.keyframe_images(far);
  Deformation after = before;
  for (size_t i = 0; i < far.size(); ++i) {
    std::vector<Points> images;
    for (const Points& key : in_keyframes) images.push_back({key[i]});
    after = with_pin(std::move(after), far[i], posed_at(w.map(), far[i]), images);
  }
  w.commit("Hold the rest", std::move(after));
}

}  // namespace holomorph
