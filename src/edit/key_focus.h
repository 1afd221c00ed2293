// Who gets a key: one decision for the whole window.
#pragma once

#include "edit/actions/actions.h"

namespace holomorph {

/// What is open or being used in the window when a key is pressed.
struct WindowFocus {
  bool assigns_key = false;    ///< the keys window waits for the key of an action
  bool edits_field = false;    ///< a text or number field, or a control that is being dragged
  bool palette = false;        ///< the command palette is open
  bool dialog = false;         ///< a dialog or the keys window is open
  bool menu = false;           ///< a menu is open
  bool menu_was_open = false;  ///< in the last frame: the key may be what closed it
  bool panel = false;          ///< a panel has the keys
};

enum class KeyFocus { assignment, field, palette, dialog, menu, panel, canvas };

/// The first of these that is active; the canvas otherwise. Fields, the palette, dialogs and menus
/// read their keys themselves.
KeyFocus key_focus(const WindowFocus& window);

/// Whether arrows, Tab and Enter move through the items of a dialog, a menu or a panel. The palette
/// moves through its rows itself.
bool navigates_items(const WindowFocus& window);

/// Whether a key of an action runs it while a panel has the keys: those that move through the panel
/// or type into it do not.
bool acts_from_panel(const Shortcut& key, const Action& action);

}  // namespace holomorph
