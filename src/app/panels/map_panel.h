// The inspector's sections about the map itself.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// Plots the energy over the iterations, with buttons that play them. Draws nothing for maps
/// without iterations.
void convergence_section(Workspace& workspace, double scale);
/// Says whether and where the picture folds or overlaps itself, and what to do about it.
void injectivity_section(Workspace& workspace, Theme theme);

}  // namespace holomorph
