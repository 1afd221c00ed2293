// Each vertex takes the height of the depth point that reaches it first.
#include "core/mesh/draw_order.h"

#include <algorithm>

#include "core/mesh/edge_distances.h"

namespace holomorph {
namespace {

using Sources = std::vector<EdgeDistances::Source>;

/// The distance of each vertex from the vertex that is farthest from the boundary.
std::vector<double> distances_from_middle(const Mesh& mesh, const EdgeDistances& edges) {
  Sources boundary;
  for (const int v : mesh.boundary) boundary.push_back({v});
  const std::vector<double> inside = edges.from(boundary).distance;
  const auto middle = std::ranges::max_element(inside) - inside.begin();
  return edges.from(Sources{{static_cast<int>(middle)}}).distance;
}

}  // namespace

std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths,
                                 EqualHeights equals) {
  std::vector<Triangle> order = mesh.triangles;
  const EdgeDistances edges(mesh);
  if (equals == EqualHeights::outward) {
    const std::vector<double> distance = distances_from_middle(mesh, edges);
    std::ranges::stable_sort(order, {}, [&](const Triangle& t) {
      return std::max({distance[static_cast<size_t>(t[0])], distance[static_cast<size_t>(t[1])],
                       distance[static_cast<size_t>(t[2])]});
    });
  }
  Sources sources;
  std::vector<int> source_heights;
  for (const Depth& depth : depths)
    if (const auto at = locate(mesh, mesh.vertices, depth.at))
      for (const int v : mesh.triangles[static_cast<size_t>(at->triangle)]) {
        sources.push_back({v, std::abs(mesh.vertices[static_cast<size_t>(v)] - depth.at)});
        source_heights.push_back(depth.depth);
      }
  const std::vector<int> nearest = edges.from(sources).source;
  const auto height_at = [&](int v) {
    const int source = nearest[static_cast<size_t>(v)];
    return source < 0 ? 0 : source_heights[static_cast<size_t>(source)];
  };
  // A triangle between two regions belongs to the higher one.
  std::ranges::stable_sort(order, {}, [&](const Triangle& t) {
    return std::max({height_at(t[0]), height_at(t[1]), height_at(t[2])});
  });
  return order;
}

}  // namespace holomorph
