// There are about as many cells as triangles. Counting sort puts the triangles into the cells.
#include "core/mesh/locator.h"

#include <algorithm>
#include <numeric>

namespace holomorph {

MeshLocator::MeshLocator(const Mesh& mesh)
    : mesh_(mesh), grid_(box_of(mesh.vertices), mesh.triangles.size()) {
  first_.assign(grid_.size() + 1, 0);
  const auto for_each_cell = [&](const Triangle& t, auto visit) {
    Box box;
    for (const int v : t) box.include(mesh_.vertices[v]);
    grid_.for_each_cell(box, visit);
  };
  for (const Triangle& t : mesh.triangles)
    for_each_cell(t, [&](size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  triangles_.resize(static_cast<size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for_each_cell(mesh.triangles[t], [&](size_t cell) {
      triangles_[static_cast<size_t>(next[cell]++)] = static_cast<int>(t);
    });
}

std::optional<Location> MeshLocator::at(Complex z) const {
  if (!grid_.box.contains(z)) return {};
  const size_t cell = grid_.cell_of(z);
  for (int i = first_[cell + 1]; i-- > first_[cell];)
    if (const auto found =
            location_in(mesh_, mesh_.vertices, triangles_[static_cast<size_t>(i)], z))
      return found;
  return {};
}

Location MeshLocator::near(Complex z) const {
  if (const auto inside = at(z)) return *inside;
  return locate_near(mesh_, z);
}

int MeshLocator::vertex_near(Complex z) const {
  return *std::ranges::min_element(
      mesh_.triangles[static_cast<size_t>(near(z).triangle)], {},
      [&](int v) { return std::norm(mesh_.vertices[static_cast<size_t>(v)] - z); });
}

}  // namespace holomorph
