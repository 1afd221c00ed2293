// The inspector's section about the selected handles.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// What is selected, such as "Pin 4" or "3 points".
std::string selection_title(const Workspace& workspace);
/// Draws the numbers of the selection: position, rotation and scale, or the angles of a corner.
/// Always takes the height of four rows, so that what follows does not move.
void selection_section(Workspace& workspace);

}  // namespace holomorph
