// The order in which overlapping parts of the picture are drawn.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A point of the rest picture, and the height of the region around it. Heights only sort
/// triangles, so no map depends on them.
struct Depth {
  Complex at;
  int depth = 0;
  bool operator==(const Depth&) const = default;
};

/// The order of triangles of equal height: that of the mesh, or outward from its middle, so that a
/// limb lies in front of the body. The middle is the vertex farthest from the boundary, and
/// distances are measured along edges.
enum class EqualHeights { as_in_mesh, outward };

/// The triangles of a mesh from the lowest to the highest. Each triangle has the height of the
/// nearest depth point, where distances are measured along mesh edges. Depth points outside the
/// mesh are ignored. Cost: O(n log n) in the number of vertices.
std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths,
                                 EqualHeights equals = EqualHeights::as_in_mesh);

}  // namespace holomorph
