// A mesh of the same domain with fewer vertices.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A coarser mesh, and how it was made from a finer one.
struct CoarserMesh {
  Mesh mesh;
  std::vector<int> kept;  ///< for each of its vertices, the same vertex of the finer mesh
  /// Where the vertices of the finer mesh lie in it. The triangle is near the vertex along the
  /// mesh, not only in the plane. A vertex outside has a negative weight.
  std::vector<Location> locations;
};

/// A mesh with `count` of the vertices of another mesh, or more if no further edge is found that
/// can collapse. It has the same number of holes. All triangles stay counter-clockwise, and none
/// becomes a sliver. The boundary keeps only some of its vertices; the others lie within a
/// twentieth of an edge's length from that edge. `cage_vertices` is empty. Cost: O(n log n).
CoarserMesh coarser_mesh(const Mesh& mesh, size_t count);

/// A coarser mesh, as above, with few vertices. Its boundary at rest, and where it takes the
/// vertices in each of the poses, are within `tolerance` of the original. `poses` are the images of
/// the vertices. Cost: O(n log n), and some hundreds of comparisons with each pose for each vertex.
CoarserMesh coarsest_mesh(const Mesh& mesh, std::span<const Points> poses, double tolerance);

/// A mesh with `count` vertices that is close to the mesh in each of the poses. If none is found,
/// one that is close at rest. Cost: up to ten times that of coarsest_mesh().
CoarserMesh coarser_mesh(const Mesh& mesh, size_t count, std::span<const Points> poses);

}  // namespace holomorph
