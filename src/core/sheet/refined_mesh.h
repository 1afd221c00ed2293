// A mesh with each triangle divided in four, at the middles of its edges.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

struct RefinedMesh {
  Mesh mesh;  ///< the coarse mesh's vertices first, in their order
  /// Where the vertices that the coarse mesh does not have lie in it. On the outline, a vertex may
  /// lie outside of its triangle, next to an edge.
  std::vector<Location> locations;

  /// The values of a map that is linear in each triangle of the coarse mesh, continued to vertices
  /// outside. The four parts of a triangle have its derivatives, so that none is flipped unless it
  /// is.
  VectorXc prolonged(const Mesh& coarse, const VectorXc& f) const;
};

/// Divides the triangles of a mesh of the inside of a cage. Middles of edges on the outline move to
/// the middle of their part of the cage, or less far if a part of their triangle would get too
/// small. Cost: O(n log n) in the number of triangles.
RefinedMesh refined_mesh(const Cage& cage, const Mesh& coarse);

}  // namespace holomorph
