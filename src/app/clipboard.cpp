// GLFW's clipboard holds only text, so pictures go through the desktop's own tools.
#include "app/clipboard.h"

#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "system/process.h"

namespace holomorph {
namespace {

/// The command that suits the display and is installed. Throws Error if there is none.
std::vector<std::string> tool(std::vector<std::string> wayland, std::vector<std::string> x11) {
  const char* display = std::getenv("WAYLAND_DISPLAY");
  if (display && *display && has_program(wayland[0])) return wayland;
  if (has_program(x11[0])) return x11;
  throw Error(ErrorKind::failed,
              "Copying and pasting pictures needs xclip or, on Wayland, wl-clipboard. Install one "
              "of them.");
}

}  // namespace

std::string picture_on_clipboard(const std::function<bool()>& keep_going) {
  const auto finished =
      run_program(tool({"wl-paste", "--type", "image/png"},
                       {"xclip", "-selection", "clipboard", "-target", "image/png", "-out"}),
                  "", {.keep_running = keep_going});
  if (!finished || finished->status != 0 || finished->output.empty())
    throw Error(ErrorKind::bad_input, "There is no picture on the clipboard.");
  return finished->output;
}

void put_on_clipboard(const std::string& png, const std::function<bool()>& keep_going) {
  const auto finished =
      run_program(tool({"wl-copy", "--type", "image/png"},
                       {"xclip", "-selection", "clipboard", "-target", "image/png", "-in"}),
                  png, {.keep_running = keep_going});
  if (!finished || finished->status != 0)
    throw Error(ErrorKind::failed, "Could not copy the picture to the clipboard.");
}

}  // namespace holomorph
