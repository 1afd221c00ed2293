// Films among the pictures, while a scene is edited.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Makes the frames of films at the displayed time the pictures of their layers. A frame that is
/// not decoded yet follows later, after a call of `wake` on another thread.
void show_film_frames(Workspace& workspace, const std::function<void()>& wake);

/// Changes how the edited layer's film plays. Successive changes are one undo step.
void set_clip(Workspace& workspace, Clip clip);

}  // namespace holomorph
