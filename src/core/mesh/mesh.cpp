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

/// Sets the loops of the boundary. Each one belongs to the cage's loop whose first vertex it is
/// nearest to.
void set_boundary(const Cage& cage, Mesh& mesh) {
  std::vector<std::vector<int>> loops =
      boundary_loops(static_cast<int>(mesh.vertices.size()), mesh.triangles, "the mesh",
                     static_cast<int>(cage.part_count()));
  if (loops.size() != static_cast<size_t>(cage.loops().count()))
    refuse("their boundary has " + std::to_string(loops.size()) +
           " loops, but with its holes and parts, the cage has " +
           std::to_string(cage.loops().count()));
  for (Index l = 0; l < cage.loops().count(); ++l) {
    const Complex corner = cage.vertex(cage.loops().first(l));
    const auto away = [&](const std::vector<int>& loop) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const int v : loop) nearest = std::min(nearest, std::abs(mesh.vertices[v] - corner));
      return nearest;
    };
    const auto own = std::ranges::min_element(loops, {}, away);
    if (!mesh.boundary.empty()) mesh.starts.push_back(static_cast<Index>(mesh.boundary.size()));
    mesh.boundary.insert(mesh.boundary.end(), own->begin(), own->end());
    loops.erase(own);
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

Mesh joined(std::span<const Mesh> parts) {
  Mesh all;
  for (const Mesh& part : parts) {
    const int first = static_cast<int>(all.vertices.size());
    const auto moved = [first](int v) { return v + first; };
    if (!all.boundary.empty()) all.starts.push_back(static_cast<Index>(all.boundary.size()));
    for (const Index start : part.starts)
      all.starts.push_back(static_cast<Index>(all.boundary.size()) + start);
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const Triangle& t : part.triangles)
      all.triangles.push_back({moved(t[0]), moved(t[1]), moved(t[2])});
    std::ranges::transform(part.boundary, std::back_inserter(all.boundary), moved);
    std::ranges::transform(part.cage_vertices, std::back_inserter(all.cage_vertices), moved);
  }
  return all;
}

std::vector<PartMesh> parts_of(const Mesh& mesh, const Cage& cage) {
  const size_t count = static_cast<size_t>(cage.part_count());
  std::vector<PartMesh> parts(count);
  const Loops loops = mesh.boundary_loops();
  // The part of each vertex: those of the boundary are known, and triangles connect the others.
  std::vector<int> part_of_vertex(mesh.vertices.size(), -1);
  for (Index p = 0; p < cage.part_count(); ++p) {
    const auto [first, end] = loops_of_part(cage, p);
    for (Index i = loops.first(first); i < loops.end(end - 1); ++i)
      part_of_vertex[static_cast<size_t>(mesh.boundary[static_cast<size_t>(i)])] =
          static_cast<int>(p);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : mesh.triangles) {
      int part = -1;
      for (const int v : t) part = std::max(part, part_of_vertex[static_cast<size_t>(v)]);
      for (const int v : t)
        if (int& own = part_of_vertex[static_cast<size_t>(v)]; part >= 0 && own != part) {
          if (own >= 0) refuse("a triangle connects two parts");
          own = part;
          changed = true;
        }
    }
  }
  std::vector<int> index(mesh.vertices.size(), -1);
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (part_of_vertex[v] < 0) refuse("some of them are connected to no part");
    PartMesh& part = parts[static_cast<size_t>(part_of_vertex[v])];
    index[v] = static_cast<int>(part.numbers.size());
    part.numbers.push_back(static_cast<int>(v));
    part.mesh.vertices.push_back(mesh.vertices[v]);
  }
  const auto at = [&index](int v) { return index[static_cast<size_t>(v)]; };
  for (const Triangle& t : mesh.triangles)
    parts[static_cast<size_t>(part_of_vertex[static_cast<size_t>(t[0])])].mesh.triangles.push_back(
        {at(t[0]), at(t[1]), at(t[2])});
  for (size_t p = 0; p < count; ++p) {
    Mesh& part = parts[p].mesh;
    const auto [first, end] = loops_of_part(cage, static_cast<Index>(p));
    for (Index l = first; l < end; ++l) {
      if (l > first) part.starts.push_back(static_cast<Index>(part.boundary.size()));
      for (Index i = loops.first(l); i < loops.end(l); ++i)
        part.boundary.push_back(at(mesh.boundary[static_cast<size_t>(i)]));
      for (Index i = cage.loops().first(l); i < cage.loops().end(l); ++i)
        part.cage_vertices.push_back(at(mesh.cage_vertices[static_cast<size_t>(i)]));
    }
  }
  return parts;
}

Index part_count(const Mesh& mesh) {
  const Loops loops = mesh.boundary_loops();
  Index count = 0;
  for (Index l = 0; l < loops.count(); ++l) {
    Points loop;
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      loop.push_back(mesh.vertices[mesh.boundary[i]]);
    count += signed_area(loop) > 0;
  }
  return count;
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
