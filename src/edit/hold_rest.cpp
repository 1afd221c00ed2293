// Distances are measured along the edges of the mesh, so that two limbs that are close to each
// other count as far apart.
#include "edit/hold_rest.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "edit/edits/edits.h"
#include "edit/picking.h"

namespace holomorph {
namespace {

constexpr double kFar = 0.45;    ///< least distance, relative to that of the farthest point
constexpr double kAsFar = 0.85;  ///< points this far relative to the farthest belong to its part

using Edges = std::vector<std::vector<std::pair<int, double>>>;

Edges edges_of(const Mesh& mesh) {
  Edges edges(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      const double length =
          std::abs(mesh.vertices[static_cast<size_t>(a)] - mesh.vertices[static_cast<size_t>(b)]);
      edges[static_cast<size_t>(a)].push_back({b, length});
      edges[static_cast<size_t>(b)].push_back({a, length});
    }
  return edges;
}

/// Lowers `distance` to the length of the shortest path from `start`, where that is less.
void spread(const Edges& edges, int start, std::vector<double>& distance) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distance[static_cast<size_t>(start)] = 0;
  queue.push({0, start});
  while (!queue.empty()) {
    const auto [reached, at] = queue.top();
    queue.pop();
    if (reached > distance[static_cast<size_t>(at)]) continue;
    for (const auto& [next, length] : edges[static_cast<size_t>(at)]) {
      double& known = distance[static_cast<size_t>(next)];
      if (reached + length >= known) continue;
      known = reached + length;
      queue.push({known, next});
    }
  }
}

int nearest_vertex(const Mesh& mesh, Complex z) {
  const auto found = std::ranges::min_element(
      mesh.vertices, {}, [&](const Complex& vertex) { return std::abs(vertex - z); });
  return static_cast<int>(found - mesh.vertices.begin());
}

}  // namespace

Points far_points(const Mesh& mesh, std::span<const Complex> from, size_t most) {
  const Edges edges = edges_of(mesh);
  std::vector<double> distance(mesh.vertices.size(), HUGE_VAL), inside = distance;
  for (const Complex& z : from) spread(edges, nearest_vertex(mesh, z), distance);
  for (const int v : mesh.boundary) spread(edges, v, inside);
  Points far;
  double first = 0;
  while (far.size() < most) {
    const double farthest = std::ranges::max(distance);
    if (far.empty()) first = farthest;
    if (!(farthest > 0) || !std::isfinite(farthest) || farthest < kFar * first) break;
    // Of the points that are about as far, take the one that lies deepest inside, near the
    // farthest one.
    const auto tip = static_cast<int>(std::ranges::max_element(distance) - distance.begin());
    std::vector<double> from_tip(mesh.vertices.size(), HUGE_VAL);
    spread(edges, tip, from_tip);
    size_t best = static_cast<size_t>(tip);
    for (size_t v = 0; v < distance.size(); ++v)
      if (distance[v] >= kAsFar * farthest && from_tip[v] <= (1 - kAsFar) * farthest &&
          inside[v] > inside[best])
        best = v;
    far.push_back(mesh.vertices[best]);
    spread(edges, static_cast<int>(best), distance);
  }
  return far;
}

bool can_hold_rest(const Workspace& w) {
  const Deformation& deformation = w.shown.deformation();
  return deformation.has_cage() && deformation.pins.size() == 1 && w.map().has_map() &&
         w.mode == EditMode::pose && method_named(deformation.method).uses_pins;
}

void hold_rest(Workspace& w) {
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
