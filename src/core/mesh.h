// A triangle mesh of the plane domain inside a cage, and where a point lies in it.
#pragma once

#include <array>
#include <optional>

#include "core/cage.h"

namespace holomorph {

using Triangle = std::array<int, 3>;

/// Counter-clockwise triangles over `vertices`. Neighbouring vertices stand near each other in the
/// list, which is what caches and the array path like. Value type.
struct Mesh {
  Points vertices;
  std::vector<Triangle> triangles;
  /// The boundary as one closed loop of vertex numbers, counter-clockwise.
  std::vector<int> boundary;
  /// For each cage vertex the mesh vertex at the very same place.
  std::vector<int> cage_vertices;
};

/// How fine a domain mesh is.
struct MeshOptions {
  /// Wanted number of vertices; what comes out is within about a third of it for ordinary cages.
  int vertices = 8000;
};

/// Meshes the inside of a simple polygon of either orientation: conforming Delaunay triangles,
/// smaller near the boundary. Every cage vertex is a mesh vertex with the same coordinates.
/// Slivers, collinear and nearly repeated vertices are fine: where the polygon itself is
/// needle-sharp the triangles are too, and refinement stops at about three times the wanted number
/// of vertices. Throws Error for what check_rest_cage refuses. Cost: about 4 us per vertex.
Mesh domain_mesh(std::span<const Complex> polygon, const MeshOptions& options = {});

/// Meshes the inside of a rest cage. Its vertices are mesh vertices; every boundary vertex lies on
/// the cage's curves, so that the mesh's outline follows them to 5e-5 of the cage's size.
Mesh domain_mesh(const Cage& cage, const MeshOptions& options = {});

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
/// infinite, moved to the mean of the centres of the triangles around them.
Points derivative_samples(const Mesh& mesh);

}  // namespace holomorph
