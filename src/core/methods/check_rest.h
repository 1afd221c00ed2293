// Checks that a method can prepare a Rest.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// Throws an Error that names the field unless the method can use the rest: the cage must pass
/// check_rest_cage, all numbers must be finite, parameters must be in their ranges, and there must
/// be a mesh of the cage where the method needs one. Cost: linear in the samples and the mesh.
void check_rest(const Method& method, const Rest& rest);

}  // namespace holomorph
