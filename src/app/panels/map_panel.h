// The inspector's sections about the map itself.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// Plots the energy against the iteration and draws buttons that play the iterations. Draws nothing
/// if the map was not computed iteratively.
void convergence_section(Workspace& workspace, double scale);
/// Says whether and where the picture folds or overlaps itself, and what to do about it.
void injectivity_section(Workspace& workspace, Theme theme);

}  // namespace holomorph
