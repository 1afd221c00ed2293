// Which part of the picture lies on top where parts of it overlap.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A place on the picture at rest, and how high what is around it lies.
struct Depth {
  Complex at;
  int depth = 0;
  bool operator==(const Depth&) const = default;
};

/// A mesh's triangles from the lowest to the highest: each is as high as the place that is nearest
/// to it, measured through the mesh (along its edges), and keeps its turn among equals. Places
/// outside the mesh do not count. Cost: n log n in the vertices.
std::vector<Triangle> draw_order(const Mesh& mesh, std::span<const Depth> depths);

}  // namespace holomorph
