// Another method for a deformation.
#pragma once

#include "scene/deformation.h"

namespace holomorph {

/// Switches to another method and restores the parameters with which it was last used. Parts of the
/// cage are joined if the method needs one outline.
Deformation with_method(Deformation deformation, const std::string& id);

}  // namespace holomorph
