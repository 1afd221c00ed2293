// What the pointer does in one frame, as tools see it; and keys as the action table names them.
#pragma once

#include <optional>
#include <string>

#include "core/types.h"

namespace holomorph {

struct Modifiers {
  bool ctrl = false, shift = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

/// The pointer in one frame; positions in window px and in the plane.
struct Input {
  Complex px, position;
  bool pressed = false, down = false, released = false, double_clicked = false;  ///< left button
  bool inside = false;  ///< over the canvas and not over a panel
  double wheel = 0;     ///< lines scrolled upwards
  Modifiers mods;
  double now_ms = 0;  ///< of a clock that never goes back
};

/// A key by what is printed on it in the user's layout ('A', ',', ...) or by name.
enum class Key : int {
  tab = 256,
  escape,
  enter,
  backspace,
  del,
  left,
  right,
  up,
  down,
  space,
  page_up,
  page_down,
  home,
  end,
  insert,
  f1,  ///< and so on to f12
  f2,
  f6 = f1 + 5,
  f10 = f1 + 9,
  f12 = f1 + 11
};

struct Shortcut {
  int key = 0;
  Modifiers mods;
  bool operator==(const Shortcut&) const = default;

  Shortcut() = default;
  Shortcut(char letter, Modifiers mods = {}) : key(letter), mods(mods) {}
  Shortcut(Key named, Modifiers mods = {}) : key(static_cast<int>(named)), mods(mods) {}
};

/// "Ctrl+Shift+Z".
std::string text_of(const Shortcut& shortcut);
/// The other way; none when there is no such key.
std::optional<Shortcut> shortcut_named(const std::string& text);

}  // namespace holomorph
