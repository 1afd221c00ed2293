// Everything that the canvas shows, taken as a whole.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// The posed cage that reproduces the displayed map without using pins. None if the method cannot
/// compute one.
std::optional<Cage> solved_cage(const Workspace& workspace);

/// The bounding box of everything on display: pictures, cage, outline and strokes.
Box content_box(const Workspace& workspace);

}  // namespace holomorph
