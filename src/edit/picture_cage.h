// The cage that is made from the edited layer's picture.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Makes a cage from the edited layer's picture, which must exist, then calls `then`, which returns
/// whether it has used the cage. If that takes long, it happens in the background. If the cage was
/// used, a toast says how many parts of the picture are left out. Methods that allow parts get an
/// outline for each one, and others an outline around them all. `quietly`: see Workspace::perform.
void make_picture_cage(Workspace& workspace, const Method& method, bool quietly,
                       std::function<bool(Cage)> then);

/// The method that the edited layer will have when its first pin is set.
const Method& method_of_first_pin(const Workspace& workspace);

}  // namespace holomorph
