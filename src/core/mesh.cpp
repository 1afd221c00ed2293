// Questions about a mesh; making one is mesher.cpp's.
#include "core/mesh.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace holomorph {

Complex Location::in(const Mesh& mesh, std::span<const Complex> positions) const {
  const Triangle& corners = mesh.triangles[triangle];
  Complex z = 0;
  for (int k = 0; k < 3; ++k) z += weights[k] * positions[corners[k]];
  return z;
}

std::optional<Location> locate(const Mesh& mesh, std::span<const Complex> positions, Complex z) {
  for (int t = static_cast<int>(mesh.triangles.size()) - 1; t >= 0; --t) {
    const auto [i, j, k] = mesh.triangles[t];
    const Complex a = positions[i] - z, b = positions[j] - z, c = positions[k] - z;
    const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), area = wa + wb + wc;
    if (area == 0) continue;
    const bool inside = area > 0 ? wa >= 0 && wb >= 0 && wc >= 0 : wa <= 0 && wb <= 0 && wc <= 0;
    if (inside) return Location{t, {wa / area, wb / area, wc / area}};
  }
  return {};
}

Location locate_near(const Mesh& mesh, Complex z) {
  if (const auto inside = locate(mesh, mesh.vertices, z)) return *inside;
  Location best;
  double least = -std::numeric_limits<double>::infinity();
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    const Complex a = mesh.vertices[i] - z, b = mesh.vertices[j] - z, c = mesh.vertices[k] - z;
    const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), area = wa + wb + wc;
    const double here = std::min({wa, wb, wc}) / area;
    if (!(area > 0) || !(here > least)) continue;
    least = here;
    best = {static_cast<int>(t), {wa / area, wb / area, wc / area}};
  }
  check(best.triangle >= 0, "locate_near: a mesh with triangles");
  return best;
}

Points derivative_samples(const Mesh& mesh) {
  Points samples = mesh.vertices;
  std::vector<int> count(samples.size(), 0);
  std::vector<Complex> sum(samples.size());
  std::vector<char> is_cage(samples.size(), 0);
  for (const int v : mesh.cage_vertices) is_cage[v] = 1;
  for (const Triangle& corners : mesh.triangles)
    for (const int v : corners)
      if (is_cage[v]) {
        for (const int w : corners) sum[v] += mesh.vertices[w] / 3.0;
        ++count[v];
      }
  for (const int v : mesh.cage_vertices)
    if (count[v] > 0) samples[v] = sum[v] / static_cast<double>(count[v]);
  return samples;
}

}  // namespace holomorph
