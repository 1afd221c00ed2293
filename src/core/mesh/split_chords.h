// Divides the edges of a mesh that join two points of the outline through the inside.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// The same mesh with a vertex at the middle of each such edge. Afterward, every triangle has a
/// vertex inside, unless the mesh is a single triangle. Cost: O(n log n).
Mesh with_split_chords(const Mesh& mesh);

}  // namespace holomorph
