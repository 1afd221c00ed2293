// A triangle mesh of the plane domain inside a cage, and point location in it.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/cage.h"

namespace holomorph {

using Triangle = std::array<int, 3>;

/// Counter-clockwise triangles over `vertices`. Neighboring vertices are close to each other in the
/// list, which suits caches and the array path. Value type.
struct Mesh {
  Points vertices;
  std::vector<Triangle> triangles;
  /// The boundary as one closed loop of vertex indices, counter-clockwise.
  std::vector<int> boundary;
  /// For each cage vertex, the mesh vertex at exactly the same position.
  std::vector<int> cage_vertices;
};

/// A mesh of the inside of a rest cage from the caller's own triangles, of either orientation. They
/// must form one disk without a hole that fills the cage, and none of them may be flat. The
/// boundary vertices must lie on the cage to 1e-4 of the cage's size. At every cage vertex there
/// must be one of them, to 1e-9 of the size; it is moved to the exact position. The area must be
/// that of the cage to 1e-3 of the size squared. Throws Error that says which condition fails.
/// Cost: O(n log n) in the number of triangles, plus boundary vertices times cage vertices.
Mesh mesh_of(const Cage& cage, Points vertices, std::vector<Triangle> triangles);

/// For each vertex, 1 if it is on the boundary, else 0. Cost: linear.
std::vector<char> boundary_marks(const Mesh& mesh);

/// The triangle that contains a point, and the point's barycentric coordinates in it.
struct Location {
  int triangle = -1;
  std::array<double, 3> weights{};

  /// The point with the same weights for the given vertex positions.
  Complex in(const Mesh& mesh, std::span<const Complex> positions) const;
};

/// The last triangle (the one drawn on top) that contains z when the mesh's vertices are at
/// `positions`. Inverted triangles count, too. Cost: linear in the triangles, about 1 ns each.
std::optional<Location> locate(const Mesh& mesh, std::span<const Complex> positions, Complex z);

/// The same for the rest positions of the mesh. For a point outside, the triangle in which its
/// smallest barycentric coordinate is largest. The mesh must have triangles.
Location locate_near(const Mesh& mesh, Complex z);

/// The points at which derivatives are sampled: the mesh vertices, except that cage vertices, where
/// f' is generally infinite, are moved to the mean of the centers of the triangles around them.
Points derivative_samples(const Mesh& mesh);

}  // namespace holomorph
