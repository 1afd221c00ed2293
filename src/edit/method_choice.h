// Choosing a method in an editing session, without moving what is displayed.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Chooses a method for the edited layer, in one step. Each handle stays where it is displayed: if
/// pins have moved the picture and cage points act in the new method, the cage takes the displayed
/// shape, in the keyframes, too. Pins without an effect in the new method are kept.
void choose_method(Workspace& workspace, const std::string& id);
/// Turns *Prevent folds* on or off for the edited layer.
void prevent_folds(Workspace& workspace, bool on);

}  // namespace holomorph
