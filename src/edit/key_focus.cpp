// Tests the parts of the window in stacking order, from the topmost one down to the canvas.
#include "edit/key_focus.h"

namespace holomorph {

KeyFocus key_focus(const WindowFocus& window) {
  if (window.assigns_key) return KeyFocus::assignment;
  if (window.edits_field) return KeyFocus::field;
  if (window.palette) return KeyFocus::palette;
  if (window.dialog) return KeyFocus::dialog;
  if (window.menu || window.menu_was_open) return KeyFocus::menu;
  return window.panel ? KeyFocus::panel : KeyFocus::canvas;
}

bool navigates_items(const WindowFocus& window) {
  if (window.assigns_key || window.palette) return false;
  return window.dialog || window.menu || window.panel;
}

bool acts_from_panel(const Shortcut& key, const Action& action) {
  if (action.id == "view.next_panel" || action.id == "view.menu") return true;
  const int tab = static_cast<int>(Key::tab), f1 = static_cast<int>(Key::f1);
  const bool moves = key.key >= tab && key.key < f1, types = key.key < tab && !key.mods.ctrl;
  return !moves && !types;
}

}  // namespace holomorph
