// The pointer input of one frame for the tools, and the keys of the action table.
#pragma once

#include <optional>
#include <string>

#include "core/types.h"

namespace holomorph {

struct Modifiers {
  bool ctrl = false, shift = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

/// The state of the pointer in one frame: position in window px and in the plane of the edited
/// layer, buttons and wheel.
struct Input {
  Complex px, position;
  bool pressed = false, down = false, released = false, double_clicked = false;  ///< left button
  bool inside = false;  ///< over the canvas and not over a panel
  double wheel = 0;     ///< lines scrolled up
  Modifiers mods;
  double now_ms = 0;  ///< monotonic clock
};

/// Keys that have a name. Other keys are identified by their character in the user's layout: 'A',
/// ',', ...
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
  f1,  ///< f1 to f12 are consecutive
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

/// The name of a shortcut, such as "Ctrl+Shift+Z".
std::string text_of(const Shortcut& shortcut);
/// The inverse of text_of; none if there is no such key.
std::optional<Shortcut> shortcut_named(const std::string& text);

}  // namespace holomorph
