// Divides all triangles of a mesh into equal ones.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// The mesh with every edge divided into this many equal parts, and every triangle into its square
/// of similar ones. The vertices are numbered anew, so that neighbors stay close in the list. Cost:
/// O(n log n).
Mesh divided(const Mesh& mesh, int parts);

}  // namespace holomorph
