// Vertices that are close in the list are close in the plane, so every k-th vertex is taken.
#include "core/mesh/area_samples.h"

#include <algorithm>

namespace holomorph {

std::vector<AreaSample> area_samples(const Mesh& mesh, size_t count, const Points& wanted) {
  std::vector<double> areas(mesh.vertices.size(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Complex at = mesh.vertices[static_cast<size_t>(a)];
    const double third = cross(mesh.vertices[static_cast<size_t>(b)] - at,
                               mesh.vertices[static_cast<size_t>(c)] - at) /
                         6;
    for (const int v : {a, b, c}) areas[static_cast<size_t>(v)] += third;
  }
  const size_t step = std::max<size_t>(1, mesh.vertices.size() / std::max<size_t>(count, 1));
  std::vector<char> taken(mesh.vertices.size(), 0);
  for (size_t v = step - 1; v < taken.size(); v += step) taken[v] = 1;
  taken.back() = 1;
  for (const Complex& z : wanted) {
    const auto nearest = std::ranges::min_element(
        mesh.vertices, {}, [&](Complex vertex) { return std::norm(vertex - z); });
    taken[static_cast<size_t>(nearest - mesh.vertices.begin())] = 1;
  }
  std::vector<AreaSample> samples;
  double area = 0;
  for (size_t v = 0; v < areas.size(); ++v) {
    area += areas[v];
    if (!taken[v]) continue;
    samples.push_back({static_cast<int>(v), area});
    area = 0;
  }
  return samples;
}

}  // namespace holomorph
