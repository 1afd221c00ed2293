// The mesh on which method `sheet` finds its maps.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A mesh of the inside of a cage whose edges are half as long as the picture is wide there
/// (HalfWidth), so that a limb is four triangles across, but at most 4 % of its size. It depends on
/// the cage alone, so that all programs find the same map. Every triangle has a vertex inside. At
/// most about 2,500 vertices, unless the outline has more. Cost: 50 ms.
Mesh solving_mesh(const Cage& cage);

}  // namespace holomorph
