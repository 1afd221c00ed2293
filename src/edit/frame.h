// The frame of a picture: what the sides of its rectangle do while pins move what is inside.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Whether a cage is a rectangle with horizontal and vertical sides, which can slide along
/// themselves.
bool is_upright_rectangle(const Cage& cage);
/// A deformation of the edited layer whose method has just been chosen: the sides of an opaque
/// picture slide along themselves if the method can do that. A frame that was set before stays.
Deformation with_usual_frame(const Workspace& workspace, Deformation deformation);
/// Whether the edited layer has a frame to choose.
bool can_choose_frame(const Workspace& workspace);

/// What is farther than a radius from all pins is held. The radius is kept within the picture.
Deformation held_beyond(Deformation deformation, double radius);
/// Whether the edited layer has a frame, pins, and a rest of the picture that is not held yet.
bool can_hold_beyond(const Workspace& workspace);
/// Holds what is far from the pins, in one step.
void hold_beyond(Workspace& workspace);
/// Lets it go again, in one step.
void let_go(Workspace& workspace);

}  // namespace holomorph
