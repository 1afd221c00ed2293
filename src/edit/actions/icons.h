// The icons of assets/icons. In the interface's fonts, each is a character of the private use area.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace holomorph {

/// The names of the files in assets/icons, sorted. The build checks that they agree.
inline constexpr const char* kIconNames[] = {
    "add",   "angle",    "attach",   "auto-key",  "brush",    "cage",   "check",   "clock",
    "close", "compare",  "down",     "duplicate", "export",   "eye",    "eye-off", "film",
    "fit",   "folder",   "help",     "key",       "lock",     "loop",   "mesh",    "minus",
    "more",  "next",     "onion",    "outline",   "pause",    "pen",    "picture", "pin",
    "play",  "previous", "redo",     "reset",     "right",    "search", "select",  "snap",
    "soft",  "stroke",   "symmetry", "to-end",    "to-start", "trash",  "undo",    "unlock",
    "up",    "warning"};

inline constexpr unsigned kFirstIcon = 0xe000;  ///< the code point of the first name

struct IconText {
  char utf8[4] = {};
};
inline constexpr auto kIconTexts = [] {
  std::array<IconText, std::size(kIconNames)> texts{};
  for (size_t i = 0; i < texts.size(); ++i) {
    const unsigned code = kFirstIcon + static_cast<unsigned>(i);
    texts[i] = {{static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 63)),
                 static_cast<char>(0x80 | (code & 63)), 0}};
  }
  return texts;
}();

/// The text that draws an icon, in UTF-8. A name that does not exist is a compile error.
consteval const char* icon_named(std::string_view name) {
  for (size_t i = 0; i < std::size(kIconNames); ++i)
    if (name == kIconNames[i]) return kIconTexts[i].utf8;
  throw "no icon has this name";
}

}  // namespace holomorph
