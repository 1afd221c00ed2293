// Dijkstra's algorithm, started from all depth points together. Each vertex takes the height of the
// depth point that reaches it first.
#include "core/mesh/draw_order.h"

#include <algorithm>
#include <queue>

namespace holomorph {

std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths) {
  struct Entry {
    double distance;
    int vertex, height;
    bool operator>(const Entry& other) const { return distance > other.distance; }
  };
  const size_t n = mesh.vertices.size();
  std::vector<std::vector<int>> neighbors(n);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      neighbors[static_cast<size_t>(t[k])].push_back(t[(k + 1) % 3]);
      neighbors[static_cast<size_t>(t[(k + 1) % 3])].push_back(t[k]);
    }
  const auto distance = [&](int a, Complex to) {
    return std::abs(mesh.vertices[static_cast<size_t>(a)] - to);
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waves;
  for (const Depth& depth : depths)
    if (const auto at = locate(mesh, mesh.vertices, depth.at))
      for (const int v : mesh.triangles[static_cast<size_t>(at->triangle)])
        waves.push({distance(v, depth.at), v, depth.depth});
  std::vector<bool> reached(n);
  std::vector<int> heights(n, 0);
  while (!waves.empty()) {
    const Entry step = waves.top();
    waves.pop();
    const size_t v = static_cast<size_t>(step.vertex);
    if (reached[v]) continue;
    reached[v] = true;
    heights[v] = step.height;
    for (const int next : neighbors[v])
      if (!reached[static_cast<size_t>(next)])
        waves.push({step.distance + distance(next, mesh.vertices[v]), next, step.height});
  }
  std::vector<Triangle> order = mesh.triangles;
  // A triangle between two regions belongs to the higher one.
  const auto height = [&](const Triangle& t) {
    return std::max({heights[static_cast<size_t>(t[0])], heights[static_cast<size_t>(t[1])],
                     heights[static_cast<size_t>(t[2])]});
  };
  std::ranges::stable_sort(order, {}, height);
  return order;
}

}  // namespace holomorph
