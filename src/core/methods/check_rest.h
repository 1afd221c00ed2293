// Checks that a method can prepare a Rest.
#pragma once

#include "core/maps/method.h"

namespace holomorph {

/// Throws an Error that names the invalid field if the method cannot use the rest. The cage must
/// pass check_rest_cage, all numbers must be finite, and parameters must be in their ranges. If the
/// method needs a mesh, the rest must have a mesh of the cage. Cost: linear in the samples and the
/// mesh.
void check_rest(const Method& method, const Rest& rest);

}  // namespace holomorph
