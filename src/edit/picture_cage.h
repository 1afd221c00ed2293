// The cage that is made from the edited layer's picture.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Makes a cage from the edited layer's picture, which must exist, then calls `then`, which returns
/// whether it has used the cage. If that takes long, it happens in the background. If the cage was
/// used, a toast says how many parts of the picture are left out.
void make_picture_cage(Workspace& workspace, std::function<bool(Cage)> then);

}  // namespace holomorph
