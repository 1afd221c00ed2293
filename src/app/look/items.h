// What all controls share: tooltips, the ring of the keyboard focus, and names for tests.
#pragma once

#include <imgui.h>

#include <map>
#include <string>

#include "app/look/text.h"
#include "edit/actions/actions.h"

namespace holomorph {

/// While an object of this class exists, Tab stops at the items that are added. It goes from field
/// to field, and arrow keys reach all other items.
class TabStop {
 public:
  TabStop();
  ~TabStop();
  TabStop(const TabStop&) = delete;
  TabStop& operator=(const TabStop&) = delete;
};

/// Draws the ring of the keyboard focus around the last item, if it has the focus.
void draw_focus_ring(float rounding);

/// Shows a text as a tooltip, in lines of moderate length, if the pointer is on the last drawn
/// item. Tooltips are hidden while a menu or the palette is open.
void tooltip(const std::string& text);
/// Shows an action's label, keys and hint as a tooltip if the pointer is on the last drawn item.
void tooltip_of(const Action& action);
/// Hides tooltips in this frame. Call this before drawing panels.
void suppress_tooltips(bool suppressed);

/// Where named items were drawn in the current frame, for the state file: left, top, right, bottom.
const std::map<std::string, ImVec4>& item_boxes();
/// Names the last item. If several items have the same name, the first keeps it.
void name_item(const std::string& name);
void forget_item_boxes();

}  // namespace holomorph
