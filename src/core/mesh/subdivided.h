// A finer mesh inside the triangles of a mesh.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// The mesh with each edge split into `pieces` equal pieces, and each triangle into pieces^2
/// congruent ones. Vertices are renumbered so that neighbors are close in the list. New boundary
/// vertices lie on the edges of the mesh, not on the curves of the cage. Cost: O(n log n).
Mesh subdivided(const Mesh& mesh, int pieces);

}  // namespace holomorph
