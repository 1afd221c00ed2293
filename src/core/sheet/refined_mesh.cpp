#include "core/sheet/refined_mesh.h"

#include <algorithm>
#include <map>
#include <ranges>

#include "core/geometry/orientation.h"
#include "core/maps/arc.h"

namespace holomorph {
namespace {

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) {
  return std::minmax(a, b);
}

/// The four parts of a triangle whose corner k is opposite the middle k.
std::array<Triangle, 4> parts_of(const Triangle& t, const std::array<int, 3>& middles) {
  return {Triangle{t[0], middles[2], middles[1]}, Triangle{t[1], middles[0], middles[2]},
          Triangle{t[2], middles[1], middles[0]}, Triangle{middles[0], middles[1], middles[2]}};
}

}  // namespace

VectorXc RefinedMesh::prolonged(const Mesh& coarse, const VectorXc& f) const {
  VectorXc fine(f.size() + static_cast<Index>(locations.size()));
  fine.head(f.size()) = f;
  for (size_t i = 0; i < locations.size(); ++i)
    fine[f.size() + static_cast<Index>(i)] = locations[i].in(coarse, as_span(f));
  return fine;
}

RefinedMesh refined_mesh(const Cage& cage, const Mesh& coarse) {
  RefinedMesh refined;
  Mesh& mesh = refined.mesh;
  mesh.vertices = coarse.vertices;
  mesh.cage_vertices = coarse.cage_vertices;
  std::map<Edge, int> middles;
  for (size_t i = 0; i < coarse.triangles.size(); ++i) {
    const Triangle& t = coarse.triangles[i];
    std::array<int, 3> own;
    for (size_t k = 0; k < 3; ++k) {
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const auto [at, is_new] =
          middles.try_emplace(edge_of(a, b), static_cast<int>(mesh.vertices.size()));
      own[k] = at->second;
      if (!is_new) continue;
      mesh.vertices.push_back(
          0.5 * (mesh.vertices[static_cast<size_t>(a)] + mesh.vertices[static_cast<size_t>(b)]));
      Location& location = refined.locations.emplace_back(Location{static_cast<int>(i)});
      location.weights[(k + 1) % 3] = location.weights[(k + 2) % 3] = 0.5;
    }
    for (const Triangle& part : parts_of(t, own)) mesh.triangles.push_back(part);
  }
  const Loops loops = coarse.boundary_loops();
  const Cage turned = oriented(cage);
  const std::vector<Arc> arcs = boundary_arcs(turned, coarse);
  for (const Index start : coarse.holes) mesh.holes.push_back(2 * start);
  for (size_t i = 0; i < coarse.boundary.size(); ++i) {
    const int from = coarse.boundary[i],
              to = coarse.boundary[static_cast<size_t>(loops.next(static_cast<Index>(i)))],
              middle = middles.at(edge_of(from, to));
    mesh.boundary.push_back(from);
    mesh.boundary.push_back(middle);
    if (arcs[i].segment < 0) continue;
    Location& location = refined.locations[static_cast<size_t>(middle) - coarse.vertices.size()];
    const size_t parent = static_cast<size_t>(location.triangle);
    Complex& z = mesh.vertices[static_cast<size_t>(middle)];
    const Complex start = z;
    constexpr double kSmallest = 0.2;  // of a part's share of the area of its triangle
    constexpr int kHalvings = 6;
    const double least = kSmallest * area_of(coarse, coarse.triangles[parent]) / 4;
    Complex by = point_on(turned, arcs[i], 0.5) - start;
    for (int halving = 0;; ++halving, by *= 0.5) {
      z = halving < kHalvings ? start + by : start;
      if (halving >= kHalvings || std::ranges::all_of(std::views::iota(0, 4), [&](int part) {
            return area_of(mesh, mesh.triangles[4 * parent + static_cast<size_t>(part)]) >= least;
          }))
        break;
    }
    const Triangle& t = coarse.triangles[parent];
    const double area = area_of(coarse, t);
    for (int k = 0; k < 3; ++k)
      location.weights[static_cast<size_t>(k)] =
          0.5 *
          cross(opposite_side(coarse, t, k),
                z - coarse.vertices[static_cast<size_t>(t[static_cast<size_t>((k + 1) % 3)])]) /
          area;
  }
  return refined;
}

}  // namespace holomorph
