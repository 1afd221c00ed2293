// A mesh with each triangle divided in four, at the middles of its edges.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

struct RefinedMesh {
  Mesh mesh;  ///< the coarse mesh's vertices first, in their order
  /// Of all further vertices, in the coarse mesh. Those on the outline may lie outside of their
  /// triangle, next to an edge.
  std::vector<Location> locations;

  /// The values of a map that is linear in each triangle of the coarse mesh, continued to vertices
  /// outside. The four parts of a triangle have its derivatives, so that none is flipped unless it
  /// is.
  VectorXc prolonged(const Mesh& coarse, const VectorXc& f) const;
};

/// Divides the triangles of a mesh of the inside of a cage. Middles of edges on the outline move to
/// the middle of their part of the cage, or as far toward it as no part of their triangle gets too
/// small. Cost: O(n log n) in the number of triangles.
RefinedMesh refined_mesh(const Cage& cage, const Mesh& coarse);

}  // namespace holomorph
