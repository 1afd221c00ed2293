#include "core/mesh/split_chords.h"

#include <algorithm>
#include <map>

namespace holomorph {

Mesh with_split_chords(const Mesh& mesh) {
  using Edge = std::pair<int, int>;
  const std::vector<char> outer = boundary_marks(mesh);
  std::map<Edge, int> seen;  // how many triangles an edge between outline vertices has
  const auto between = [](const Triangle& t, size_t corner) {
    return Edge(std::minmax(t[(corner + 1) % 3], t[(corner + 2) % 3]));
  };
  const auto joins_outline = [&](const Edge& edge) {
    return outer[static_cast<size_t>(edge.first)] && outer[static_cast<size_t>(edge.second)];
  };
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      if (const Edge edge = between(t, k); joins_outline(edge)) ++seen[edge];
  Mesh split = mesh;
  std::map<Edge, int> middles;
  for (const auto& [edge, triangles] : seen) {
    if (triangles < 2) continue;
    middles[edge] = static_cast<int>(split.vertices.size());
    split.vertices.push_back(0.5 * (mesh.vertices[static_cast<size_t>(edge.first)] +
                                    mesh.vertices[static_cast<size_t>(edge.second)]));
  }
  if (middles.empty()) return split;
  split.triangles.clear();
  // Each cut divides the part of the triangle that has the whole edge.
  for (const Triangle& whole : mesh.triangles) {
    std::vector<Triangle> parts = {whole};
    for (size_t k = 0; k < 3; ++k) {
      const auto middle = middles.find(between(whole, k));
      if (middle == middles.end()) continue;
      const int a = whole[(k + 1) % 3], b = whole[(k + 2) % 3];
      const auto cut = std::ranges::find_if(parts, [&](const Triangle& part) {
        return std::ranges::count(part, a) > 0 && std::ranges::count(part, b) > 0;
      });
      Triangle other = *cut;
      std::ranges::replace(*cut, a, middle->second);
      std::ranges::replace(other, b, middle->second);
      parts.push_back(other);
    }
    split.triangles.insert(split.triangles.end(), parts.begin(), parts.end());
  }
  return split;
}

}  // namespace holomorph
