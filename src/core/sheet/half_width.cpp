#include "core/sheet/half_width.h"

#include <algorithm>

#include "core/geometry/polygon.h"

namespace holomorph {

HalfWidth::HalfWidth(const Mesh& mesh) {
  Polygon outline{{}, mesh.holes};
  for (const int v : mesh.boundary) outline.points.push_back(mesh.vertices[static_cast<size_t>(v)]);
  const auto add = [&](Complex center) {
    disks_.push_back({center, nearest_on_polygon(outline, center).distance});
  };
  for (const Complex& z : mesh.vertices) add(z);
  for (const auto& [a, b, c] : mesh.triangles)
    add((mesh.vertices[static_cast<size_t>(a)] + mesh.vertices[static_cast<size_t>(b)] +
         mesh.vertices[static_cast<size_t>(c)]) /
        3.0);
  std::ranges::sort(disks_, std::greater{}, &Disk::radius);
}

double HalfWidth::at(Complex z) const {
  // A disk between two centers would reach a little farther than theirs.
  constexpr double kReach = 1.05;
  for (const Disk& disk : disks_)
    if (std::norm(z - disk.center) <= kReach * kReach * disk.radius * disk.radius)
      return disk.radius;
  return 0;
}

}  // namespace holomorph
