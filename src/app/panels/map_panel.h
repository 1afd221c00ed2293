// What the inspector says of the map itself.
#pragma once

#include "edit/workspace.h"
#include "scene/preferences.h"

namespace holomorph {

/// Energy over iterations, both logarithmic, and what plays them; nothing for maps without.
void convergence_section(Workspace& workspace, double scale);
/// Whether the picture lies over itself, where, and what to do about it.
void injectivity_section(Workspace& workspace, Theme theme);

}  // namespace holomorph
