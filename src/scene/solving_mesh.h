// The mesh on which method `sheet` finds its maps.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A mesh of the inside of a cage whose edges are 0.4 times as long as half of the picture's width
/// there (HalfWidth), so that a limb is five triangles across, and at most 3 % of the picture's
/// size. It depends on the cage alone, so that all programs find the same map. Every triangle has a
/// vertex inside. At most about 2,500 vertices, unless the outline has more. Each part of a
/// cage has a mesh of its own, with fewer vertices if the part is smaller. Cost: 50 ms for each.
Mesh solving_mesh(const Cage& cage);

}  // namespace holomorph
