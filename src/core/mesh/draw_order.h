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

/// The triangles of a mesh from the lowest to the highest. A triangle has the height of the nearest
/// depth point, measured through the mesh (along its edges). Triangles of equal height keep their
/// order. Points outside the mesh do not count. Cost: O(n log n) in the number of vertices.
std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths);

}  // namespace holomorph
