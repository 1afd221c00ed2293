// Pictures on the desktop's clipboard, through the programs xclip or wl-clipboard.
#pragma once

#include <functional>
#include <string>

namespace holomorph {

/// The clipboard's picture as the bytes of a PNG file. Throws Error if the clipboard holds no
/// picture, or if neither program is installed.
std::string picture_on_clipboard(const std::function<bool()>& keep_going);
/// Copies the bytes of a PNG file to the clipboard. Throws Error if that fails.
void put_on_clipboard(const std::string& png, const std::function<bool()>& keep_going);

}  // namespace holomorph
