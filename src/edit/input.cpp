// Keys in words.
#include "edit/input.h"

namespace holomorph {

std::string text_of(const Shortcut& shortcut) {
  std::string text;
  if (shortcut.mods.ctrl) text += "Ctrl+";
  if (shortcut.mods.shift && shortcut.key != '?') text += "Shift+";
  if (shortcut.mods.alt) text += "Alt+";
  switch (static_cast<Key>(shortcut.key)) {
    case Key::tab:
      return text + "Tab";
    case Key::escape:
      return text + "Esc";
    case Key::enter:
      return text + "Enter";
    case Key::backspace:
      return text + "Backspace";
    case Key::del:
      return text + "Del";
    case Key::left:
      return text + "Left";
    case Key::right:
      return text + "Right";
    case Key::up:
      return text + "Up";
    case Key::down:
      return text + "Down";
    case Key::f1:
      return text + "F1";
    case Key::space:
      return text + "Space";
  }
  return text + static_cast<char>(shortcut.key);
}

}  // namespace holomorph
