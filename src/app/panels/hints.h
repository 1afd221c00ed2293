// The first three steps, for whoever opens the program for the first time.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Draws the steps into the canvas' corner, the done ones ticked. `kept` says whether anything was
/// saved or exported. Returns false when they are not wanted any more.
bool draw_hints(const Workspace& workspace, bool kept, double scale);

}  // namespace holomorph
