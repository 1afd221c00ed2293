// The cage that is made from the edited layer's picture.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Makes a cage from the edited layer's picture, which must exist, then calls `then`. If that takes
/// long, it happens in the background. A toast names the parts of the picture that are left out.
void make_picture_cage(Workspace& workspace, std::function<void(Cage)> then);

}  // namespace holomorph
