// The inspector's sections about the map itself.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// Plots the energy over the iterations and draws buttons that play the iterations. Draws nothing
/// for maps that have none.
void convergence_section(Workspace& workspace, double scale);
/// Says whether and where the picture folds or overlaps itself, and what to do about it.
void injectivity_section(Workspace& workspace, Theme theme);

}  // namespace holomorph
