// The inspector's section about the method of the edited layer.
#pragma once

#include "app/panels/panels.h"

namespace holomorph {

/// The methods with a card. All others are under "More".
bool has_card(const std::string& method);
/// Draws a card with the picture of a method. Returns whether it was clicked.
bool method_card(const std::string& id, const std::string& label, const std::string& picture,
                 bool chosen, float width);
/// Draws the cards, the switch that prevents folds, and the settings of the method.
PanelAnswer method_section(Workspace& workspace, Preferences& preferences);

}  // namespace holomorph
