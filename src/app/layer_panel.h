// The layers as a list, the top one first, and the background under them.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Draws into the current window: choosing, showing, locking, naming, ordering.
void layer_section(Workspace& workspace, double scale);

}  // namespace holomorph
