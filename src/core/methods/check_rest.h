// Checks that a method can prepare a Rest.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// Throws an Error that names the invalid field if the method cannot use the rest. The cage must
/// pass check_rest_cage, all numbers must be finite, and parameters must be in their ranges. A
/// method that needs a mesh must get a mesh of the cage. Cost: linear in the samples and the mesh.
void check_rest(const Method& method, const Rest& rest);

}  // namespace holomorph
