// What a Rest must be for a method to prepare it.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// Throws Error that names the field unless the method can use the rest: a cage that can rest, only
/// finite numbers, parameters in their ranges, and a mesh of the cage where the method needs one.
/// Cost: linear in the samples and the mesh.
void check_rest(const Method& method, const Rest& rest);

}  // namespace holomorph
