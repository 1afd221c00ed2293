// There are about as many cells as triangles. Counting sort puts the triangles into the cells.
#include "core/mesh/locator.h"

#include <algorithm>
#include <numeric>

namespace holomorph {

MeshLocator::MeshLocator(const Mesh& mesh) : mesh_(mesh), box_(box_of(mesh.vertices)) {
  const double cell = std::sqrt(std::max(box_.width() * box_.height(), 1e-300) /
                                static_cast<double>(mesh.triangles.size() + 1));
  columns_ = static_cast<int>(std::clamp(box_.width() / cell, 1.0, 4096.0));
  rows_ = static_cast<int>(std::clamp(box_.height() / cell, 1.0, 4096.0));
  first_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_) + 1, 0);
  const auto for_each_cell = [&](const Triangle& t, auto visit) {
    Box box;
    for (const int v : t) box.include(mesh_.vertices[v]);
    const size_t columns = static_cast<size_t>(columns_), low = cell_of({box.left, box.bottom}),
                 high = cell_of({box.right, box.top});
    for (size_t r = low / columns; r <= high / columns; ++r)
      for (size_t c = low % columns; c <= high % columns; ++c) visit(r * columns + c);
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

size_t MeshLocator::cell_of(Complex z) const {
  const auto index = [](double x, double low, double width, int cells) {
    return static_cast<size_t>(
        std::clamp((x - low) / std::max(width, 1e-300) * cells, 0.0, cells - 1.0));
  };
  return index(z.imag(), box_.bottom, box_.height(), rows_) * static_cast<size_t>(columns_) +
         index(z.real(), box_.left, box_.width(), columns_);
}

std::optional<Location> MeshLocator::at(Complex z) const {
  if (!box_.contains(z)) return {};
  const size_t cell = cell_of(z);
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
