// Names of keys.
#include "edit/input.h"

#include <array>
#include <utility>

namespace holomorph {
namespace {

constexpr std::array<std::pair<Key, const char*>, 15> kNames{{{Key::tab, "Tab"},
                                                              {Key::escape, "Esc"},
                                                              {Key::enter, "Enter"},
                                                              {Key::backspace, "Backspace"},
                                                              {Key::del, "Del"},
                                                              {Key::left, "Left"},
                                                              {Key::right, "Right"},
                                                              {Key::up, "Up"},
                                                              {Key::down, "Down"},
                                                              {Key::space, "Space"},
                                                              {Key::page_up, "PageUp"},
                                                              {Key::page_down, "PageDown"},
                                                              {Key::home, "Home"},
                                                              {Key::end, "End"},
                                                              {Key::insert, "Insert"}}};

std::string name_of_key(int key) {
  for (const auto& [named, name] : kNames)
    if (key == static_cast<int>(named)) return name;
  const int f = key - static_cast<int>(Key::f1);
  if (f >= 0 && f < 12) return "F" + std::to_string(f + 1);
  return std::string(1, static_cast<char>(key));
}

}  // namespace

std::string text_of(const Shortcut& shortcut) {
  std::string text;
  if (shortcut.mods.ctrl) text += "Ctrl+";
  if (shortcut.mods.shift) text += "Shift+";
  if (shortcut.mods.alt) text += "Alt+";
  return text + name_of_key(shortcut.key);
}

std::optional<Shortcut> shortcut_named(const std::string& text) {
  Shortcut shortcut;
  std::string rest = text;
  for (auto& [prefix, held] :
       {std::pair("Ctrl+", &shortcut.mods.ctrl), std::pair("Shift+", &shortcut.mods.shift),
        std::pair("Alt+", &shortcut.mods.alt)})
    if (rest.starts_with(prefix) && rest.size() > std::string(prefix).size()) {
      *held = true;
      rest = rest.substr(std::string(prefix).size());
    }
  if (rest.size() == 1 && rest[0] > ' ' && rest[0] < 127) {
    shortcut.key = rest[0];
    return shortcut;
  }
  for (int key = static_cast<int>(Key::tab); key <= static_cast<int>(Key::f12); ++key)
    if (name_of_key(key) == rest) {
      shortcut.key = key;
      return shortcut;
    }
  return {};
}

}  // namespace holomorph
