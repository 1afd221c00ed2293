// What the canvas shows as a whole.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// The posed cage that gives the displayed map without pins, if the method can compute one.
std::optional<Cage> solved_cage(const Workspace& workspace);

/// The bounding box of everything on display: pictures, cage, outline and strokes.
Box content_box(const Workspace& workspace);

}  // namespace holomorph
