// Halves the points across the longer side of their bounding box until the groups are small enough.
#include "core/geometry/point_groups.h"

#include <algorithm>
#include <numeric>

namespace holomorph {
namespace {

PointGroup group_of(std::span<const Complex> points, std::span<const Index> indices) {
  PointGroup group{{indices.begin(), indices.end()}, {}, 0, 0};
  for (const Index i : indices) group.points.push_back(points[static_cast<size_t>(i)]);
  group.center = box_of(group.points).center();
  for (const Complex& z : group.points)
    group.radius = std::max(group.radius, std::abs(z - group.center));
  return group;
}

void divide(std::span<const Complex> points, std::span<Index> indices, size_t most,
            std::vector<PointGroup>& groups) {
  if (indices.size() <= most) {
    groups.push_back(group_of(points, indices));
    return;
  }
  const auto at = [points](Index i) { return points[static_cast<size_t>(i)]; };
  Box box;
  for (const Index i : indices) box.include(at(i));
  const bool is_wide = box.width() > box.height();
  const size_t half = indices.size() / 2;
  std::ranges::nth_element(indices, indices.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](Index i) { return is_wide ? at(i).real() : at(i).imag(); });
  divide(points, indices.first(half), most, groups);
  divide(points, indices.subspan(half), most, groups);
}

}  // namespace

std::vector<PointGroup> point_groups(std::span<const Complex> points, size_t most) {
  std::vector<Index> indices(points.size());
  std::iota(indices.begin(), indices.end(), Index{0});
  std::vector<PointGroup> groups;
  if (!points.empty()) divide(points, indices, most, groups);
  return groups;
}

}  // namespace holomorph
