// A triangle mesh of the plane domain inside a cage, and point location in it.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/cage.h"

namespace holomorph {

using Triangle = std::array<int, 3>;

/// Counter-clockwise triangles over `vertices`. Vertices that are close in the plane are also close
/// in the list, which helps caches and the array path. Value type.
struct Mesh {
  Points vertices;
  std::vector<Triangle> triangles;
  /// The boundary as closed loops of vertex indices, with the inside on their left, in the order of
  /// the cage's loops.
  std::vector<int> boundary;
  /// For each cage vertex, the mesh vertex at exactly the same position.
  std::vector<int> cage_vertices;
  std::vector<Index> starts = {};  ///< of the loops of `boundary` after the first one

  Loops boundary_loops() const { return {static_cast<Index>(boundary.size()), starts}; }
};

/// The side of a triangle opposite a corner (0, 1 or 2), counter-clockwise. Cost: constant.
inline Complex opposite_side(const Mesh& mesh, const Triangle& t, int corner) {
  return mesh.vertices[static_cast<size_t>(t[(corner + 2) % 3])] -
         mesh.vertices[static_cast<size_t>(t[(corner + 1) % 3])];
}

/// The area of a triangle of the mesh.
inline double area_of(const Mesh& mesh, const Triangle& t) {
  return 0.5 * cross(opposite_side(mesh, t, 2), opposite_side(mesh, t, 0));
}

/// Makes a mesh of the inside of a rest cage from the caller's own triangles, of either
/// orientation. The triangles must form one piece that fills the cage, with the same holes, and no
/// triangle may be flat. The boundary vertices must lie on the cage to within 1e-4 of the cage's
/// size. At every cage vertex, there must be a boundary vertex within 1e-9 of the size. This
/// boundary vertex is moved to the exact position. The areas of the mesh and the cage must agree to
/// within 1e-3 of the size squared. Throws an Error that names the failed condition. Cost: O(n log
/// n) in the number of triangles, plus boundary vertices times cage vertices.
Mesh mesh_of(const Cage& cage, Points vertices, std::vector<Triangle> triangles);

/// Meshes of the parts of a cage, in order, as one mesh of the cage.
Mesh joined(std::span<const Mesh> parts);

/// The meshes of the parts of a cage, taken from a mesh of the cage. The numbers are those that the
/// vertices have there.
struct PartMesh {
  Mesh mesh;
  std::vector<int> numbers;
};
std::vector<PartMesh> parts_of(const Mesh& mesh, const Cage& cage);

/// The number of outlines in the boundary.
Index part_count(const Mesh& mesh);

/// For each vertex, 1 if it is on the boundary, else 0. Cost: linear.
std::vector<char> boundary_marks(const Mesh& mesh);

/// The triangle that contains a point, and the point's barycentric coordinates in it.
struct Location {
  int triangle = -1;
  std::array<double, 3> weights{};

  /// The point with the same barycentric coordinates when the vertices are at `positions`.
  Complex in(const Mesh& mesh, std::span<const Complex> positions) const;
};

/// Where z lies in one triangle when the mesh's vertices are at `positions`; none if it lies
/// outside or the triangle is flat.
std::optional<Location> location_in(const Mesh& mesh, std::span<const Complex> positions,
                                    int triangle, Complex z);

/// The last triangle (the one drawn on top) that contains z when the mesh's vertices are at
/// `positions`. Inverted triangles count, too. Cost: about 1 ns per triangle.
std::optional<Location> locate(const Mesh& mesh, std::span<const Complex> positions, Complex z);

/// Locates z at the rest positions of the mesh. For z outside the mesh, returns the triangle in
/// which the smallest barycentric coordinate of z is largest. The mesh must have triangles.
Location locate_near(const Mesh& mesh, Complex z);

/// The points at which derivatives are sampled: the mesh vertices, except that cage vertices, where
/// f' is generally infinite, are moved to the mean of the centers of the triangles around them.
Points derivative_samples(const Mesh& mesh);

}  // namespace holomorph
