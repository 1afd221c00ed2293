// The order in which overlapping parts of the picture are drawn.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A point of the rest picture, and the height of the region around it.
struct Depth {
  Complex at;
  int depth = 0;
  bool operator==(const Depth&) const = default;
};

/// The triangles of a mesh from the lowest to the highest. Each triangle has the height of the
/// nearest depth point, where distances are measured along mesh edges. Of triangles of equal
/// height, those farther from the middle of the mesh, along its edges, are higher, so that a limb
/// lies in front of the body. The middle is the vertex farthest from the boundary. Depth points
/// outside the mesh are ignored. Cost: O(n log n) in the number of vertices.
std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths);

}  // namespace holomorph
