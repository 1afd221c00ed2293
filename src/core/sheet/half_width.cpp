#include "core/sheet/half_width.h"

#include <algorithm>

#include "core/geometry/polygon.h"

namespace holomorph {
namespace {

// A disk between two centers would reach a little farther than theirs.
constexpr double kDiskReach = 1.05;

}  // namespace

HalfWidth::HalfWidth(const Mesh& mesh) {
  Polygon outline{{}, mesh.starts};
  for (const int v : mesh.boundary) outline.points.push_back(mesh.vertices[static_cast<size_t>(v)]);
  std::vector<Disk> disks;
  std::vector<Index> edges;  // the nearest one of each vertex, which is near its triangles, too
  const auto add = [&](Complex center, Index guess) {
    const NearestPoint near = nearest_on_polygon(outline, center, guess);
    disks.push_back({center, near.distance});
    return near.edge;
  };
  for (const Complex& z : mesh.vertices) edges.push_back(add(z, edges.empty() ? 0 : edges.back()));
  for (const auto& [a, b, c] : mesh.triangles)
    add((mesh.vertices[static_cast<size_t>(a)] + mesh.vertices[static_cast<size_t>(b)] +
         mesh.vertices[static_cast<size_t>(c)]) /
            3.0,
        edges[static_cast<size_t>(a)]);
  std::ranges::sort(disks, std::greater{}, &Disk::radius);
  // Disks that a larger one reaches around say nothing. Most of the others lie along the middle.
  for (const Disk& disk : disks) {
    const auto contains = [&](const Disk& larger) {
      const double room = kDiskReach * larger.radius - disk.radius;
      return std::norm(disk.center - larger.center) <= room * room;
    };
    if (disk.radius > 0 && std::ranges::none_of(disks_, contains)) disks_.push_back(disk);
  }
}

double HalfWidth::at(Complex z, double reach) const {
  for (const Disk& disk : disks_)
    if (std::norm(z - disk.center) <= reach * reach * disk.radius * disk.radius) return disk.radius;
  return 0;
}

}  // namespace holomorph
