// The inspector's section about the selected handles.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Draws fields for the selection: position, degree, corner, depth, rotation and scale.
void selection_section(Workspace& workspace);

}  // namespace holomorph
