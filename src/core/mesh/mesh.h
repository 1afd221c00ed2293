// A triangle mesh of the plane domain inside a cage, and where a point lies in it.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/cage.h"

namespace holomorph {

using Triangle = std::array<int, 3>;

/// Counter-clockwise triangles over `vertices`. Neighboring vertices stand near each other in the
/// list, which is what caches and the array path like. Value type.
struct Mesh {
  Points vertices;
  std::vector<Triangle> triangles;
  /// The boundary as one closed loop of vertex numbers, counter-clockwise.
  std::vector<int> boundary;
  /// For each cage vertex the mesh vertex at the very same place.
  std::vector<int> cage_vertices;
};

/// A mesh of the inside of a rest cage from triangles of the caller's own, of either orientation.
/// They must make one disk without a hole, none of them flat, that fills the cage: its boundary
/// vertices lie on the cage to 1e-4 of the cage's size, every cage vertex is one of them to 1e-9 of
/// the size (and is moved to the very place), and its area is the cage's to 1e-3 of the size
/// squared. Throws Error that says what is missing. Cost: O(n log n) in the triangles, and boundary
/// vertices times cage vertices.
Mesh mesh_of(const Cage& cage, Points vertices, std::vector<Triangle> triangles);

/// For each vertex 1 when it is on the boundary, else 0. Cost: linear.
std::vector<char> boundary_marks(const Mesh& mesh);

/// A point's triangle and barycentric coordinates in it.
struct Location {
  int triangle = -1;
  std::array<double, 3> weights{};

  /// The point with the same weights in other vertex positions.
  Complex in(const Mesh& mesh, std::span<const Complex> positions) const;
};

/// The last triangle (the one drawn on top) that contains z when the mesh's vertices are at
/// `positions`; folded triangles count too. Cost: linear in the triangles, about 1 ns each.
std::optional<Location> locate(const Mesh& mesh, std::span<const Complex> positions, Complex z);

/// The same over the mesh itself, and for points outside the triangle beyond whose sides they are
/// least, in barycentric coordinates. The mesh must have triangles.
Location locate_near(const Mesh& mesh, Complex z);

/// Where derivatives are sampled: each vertex itself, but cage vertices, where f' is in general
/// infinite, moved to the mean of the centers of the triangles around them.
Points derivative_samples(const Mesh& mesh);

}  // namespace holomorph
