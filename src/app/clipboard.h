// Pictures on the desktop's clipboard, by the programs wl-clipboard or xclip.
#pragma once

#include <functional>
#include <string>

namespace holomorph {

/// The clipboard's picture as PNG bytes. Throws Error where there is none, or no such program.
std::string picture_on_clipboard(const std::function<bool()>& keep_going);
/// Puts the bytes of a PNG file there. Throws Error.
void put_on_clipboard(const std::string& png, const std::function<bool()>& keep_going);

}  // namespace holomorph
