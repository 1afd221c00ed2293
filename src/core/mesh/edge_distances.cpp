#include "core/mesh/edge_distances.h"

#include <queue>
#include <tuple>

namespace holomorph {

EdgeDistances::EdgeDistances(const Mesh& mesh) : edges_(mesh.vertices.size()) {
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const double length =
          std::abs(mesh.vertices[static_cast<size_t>(a)] - mesh.vertices[static_cast<size_t>(b)]);
      edges_[static_cast<size_t>(a)].push_back({b, length});
      edges_[static_cast<size_t>(b)].push_back({a, length});
    }
}

EdgeDistances::Reach EdgeDistances::from(std::span<const Source> sources) const {
  Reach reach{std::vector<double>(edges_.size(), HUGE_VAL), std::vector<int>(edges_.size(), -1)};
  using Entry = std::tuple<double, int, int>;  // distance, source, vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto visit = [&](double distance, int source, int vertex) {
    const auto v = static_cast<size_t>(vertex);
    if (!(distance < reach.distance[v])) return;
    reach.distance[v] = distance;
    reach.source[v] = source;
    queue.push({distance, source, vertex});
  };
  for (size_t i = 0; i < sources.size(); ++i)
    visit(sources[i].distance, static_cast<int>(i), sources[i].vertex);
  while (!queue.empty()) {
    const auto [distance, source, vertex] = queue.top();
    queue.pop();
    if (distance > reach.distance[static_cast<size_t>(vertex)]) continue;
    for (const auto& [next, length] : edges_[static_cast<size_t>(vertex)])
      visit(distance + length, source, next);
  }
  return reach;
}

}  // namespace holomorph
