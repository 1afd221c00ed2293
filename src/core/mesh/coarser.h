// A mesh of the same domain with fewer vertices.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A coarser mesh, and the vertices that it has kept.
struct CoarserMesh {
  Mesh mesh;
  std::vector<int> kept;  ///< for each of its vertices, the same vertex of the finer mesh
};

/// A mesh with about `count` of the vertices of another mesh, or as few as collapsing edges allows.
/// It has the same number of holes. All triangles stay counter-clockwise, and none becomes a
/// sliver. The boundary keeps only some of its vertices, so the covered domain changes a little.
/// `cage_vertices` is empty. Cost: O(n log n).
CoarserMesh coarser_mesh(const Mesh& mesh, size_t count);

}  // namespace holomorph
