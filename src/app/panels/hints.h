// The card with the first three steps, for new users.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Draws the first unfinished step in the corner of the canvas. `kept` says whether the work was
/// saved or exported. Returns false if the user closes the card.
bool draw_hints(const Workspace& workspace, bool kept, double scale);

}  // namespace holomorph
