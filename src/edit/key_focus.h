// Decides which part of the window receives a key press.
#pragma once

#include "edit/actions/actions.h"

namespace holomorph {

/// What is open or in use in the window when a key is pressed.
struct WindowFocus {
  bool assigns_key = false;    ///< the keys window waits for a key to assign to an action
  bool edits_field = false;    ///< a text or number field, or a control that is being dragged
  bool palette = false;        ///< the command palette is open
  bool dialog = false;         ///< a dialog or the keys window is open
  bool menu = false;           ///< a menu is open
  bool menu_was_open = false;  ///< state in the last frame; this key press may have closed the menu
  bool panel = false;          ///< a panel has the keyboard focus
};

enum class KeyFocus { assignment, field, palette, dialog, menu, panel, canvas };

/// The part that receives the key press: the first active one in the order of KeyFocus, else the
/// canvas. Fields, the palette, dialogs and menus handle their keys themselves.
KeyFocus key_focus(const WindowFocus& window);

/// Whether arrow keys, Tab and Enter move through the items of a dialog, a menu or a panel. Only
/// then is ImGui's own navigation on, because the canvas uses the same keys. The palette handles
/// these keys itself.
bool navigates_items(const WindowFocus& window);

/// Whether a key runs its action while a panel has the keyboard focus. Keys that move through the
/// panel or type into it do not, unless they move the focus elsewhere.
bool acts_from_panel(const Shortcut& key, const Action& action);

}  // namespace holomorph
