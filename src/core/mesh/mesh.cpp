// Queries on a mesh, and meshes made from given triangles. For generated triangles, see mesher.cpp.
#include "core/mesh/mesh.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/mesh/surface.h"

namespace holomorph {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::bad_input, "the triangles are not a mesh of this cage: " + why);
}

double doubled_area(const Mesh& mesh, const Triangle& t) {
  return cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
               mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

/// Finds the boundary vertex at a vertex of the cage and moves it to the exact position.
int vertex_at(Complex corner, double tolerance, Mesh& mesh) {
  const auto away = [&](int v) { return std::abs(mesh.vertices[v] - corner); };
  const int nearest = *std::ranges::min_element(mesh.boundary, {}, away);
  if (away(nearest) > tolerance)
    refuse("there is no boundary vertex at cage vertex " + point_text(corner));
  mesh.vertices[nearest] = corner;
  return nearest;
}

/// Sets the loops of the boundary, the outer one first.
void set_boundary(const Cage& cage, Mesh& mesh) {
  std::vector<std::vector<int>> loops =
      boundary_loops(static_cast<int>(mesh.vertices.size()), mesh.triangles, "the mesh");
  if (loops.size() != static_cast<size_t>(cage.loops().count()))
    refuse("they have " + std::to_string(loops.size() - 1) + " holes, but the cage has " +
           std::to_string(cage.holes.size()));
  const auto area = [&mesh](const std::vector<int>& loop) {
    Points points;
    for (const int v : loop) points.push_back(mesh.vertices[v]);
    return signed_area(points);
  };
  std::ranges::sort(loops, std::greater(), area);
  for (const std::vector<int>& loop : loops) {
    if (!mesh.boundary.empty()) mesh.holes.push_back(static_cast<Index>(mesh.boundary.size()));
    mesh.boundary.insert(mesh.boundary.end(), loop.begin(), loop.end());
  }
}

}  // namespace

Mesh mesh_of(const Cage& cage, Points vertices, std::vector<Triangle> triangles) {
  constexpr double kAtVertex = 1e-9, kAtCurve = 1e-4, kArea = 1e-3;  // of the cage's size
  check_rest_cage(cage);
  if (!std::ranges::all_of(vertices, is_finite))
    refuse("a vertex has a coordinate that is not finite");
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  const int count = static_cast<int>(mesh.vertices.size());
  for (Triangle& t : mesh.triangles) {
    if (std::ranges::any_of(t, [count](int v) { return v < 0 || v >= count; }))
      refuse("a triangle refers to a vertex that does not exist");
    if (doubled_area(mesh, t) < 0) std::swap(t[1], t[2]);
  }
  set_boundary(cage, mesh);
  const FlatCage outline = flattened(cage);
  const double size = box_of(outline).diagonal();
  for (const Complex& corner : vertices_of(cage))
    mesh.cage_vertices.push_back(vertex_at(corner, kAtVertex * size, mesh));
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const double doubled = doubled_area(mesh, t);
    if (!(doubled > 0)) refuse("the triangle at " + point_text(mesh.vertices[t[0]]) + " is flat");
    area += 0.5 * doubled;
  }
  for (const int v : mesh.boundary)
    if (nearest_on_polygon(outline, mesh.vertices[v]).distance > kAtCurve * size)
      refuse("the boundary vertex " + point_text(mesh.vertices[v]) + " is not on the cage");
  if (std::abs(area - area_of(outline)) > kArea * size * size) refuse("they do not fill the cage");
  return mesh;
}

std::vector<char> boundary_marks(const Mesh& mesh) {
  std::vector<char> marks(mesh.vertices.size(), 0);
  for (const int v : mesh.boundary) marks[static_cast<size_t>(v)] = 1;
  return marks;
}

Complex Location::in(const Mesh& mesh, std::span<const Complex> positions) const {
  const Triangle& corners = mesh.triangles[triangle];
  Complex z = 0;
  for (int k = 0; k < 3; ++k) z += weights[k] * positions[corners[k]];
  return z;
}

std::optional<Location> location_in(const Mesh& mesh, std::span<const Complex> positions,
                                    int triangle, Complex z) {
  const auto [i, j, k] = mesh.triangles[triangle];
  const Complex a = positions[i] - z, b = positions[j] - z, c = positions[k] - z;
  const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), area = wa + wb + wc;
  if (area == 0) return {};
  const bool inside = area > 0 ? wa >= 0 && wb >= 0 && wc >= 0 : wa <= 0 && wb <= 0 && wc <= 0;
  if (!inside) return {};
  return Location{triangle, {wa / area, wb / area, wc / area}};
}

std::optional<Location> locate(const Mesh& mesh, std::span<const Complex> positions, Complex z) {
  for (int t = static_cast<int>(mesh.triangles.size()) - 1; t >= 0; --t)
    if (const auto found = location_in(mesh, positions, t, z)) return found;
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
