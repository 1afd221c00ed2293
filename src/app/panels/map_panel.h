// The inspector's sections about the map itself.
#pragma once

#include <imgui.h>

#include "edit/workspace.h"

namespace holomorph {

/// A state in a few words, and its color.
struct StateText {
  std::string text;
  ImU32 color = 0;
};
/// Says whether the picture folds: for the title of the section and the status bar. Empty without a
/// map.
StateText fold_state(const Workspace& workspace);

/// Plots the energy against the iteration and draws buttons that play the iterations. Draws nothing
/// if the map was not computed iteratively.
void convergence_section(Workspace& workspace);
/// Says whether and where the picture folds or overlaps itself, and what to do about it.
void injectivity_section(Workspace& workspace);

}  // namespace holomorph
