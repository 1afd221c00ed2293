// Opens the editor in a window.
#pragma once

#include "system/file.h"

namespace holomorph {

struct EditorOptions {
  Path file;                   ///< a scene or picture to open; if empty, shows the welcome page
  bool allow_outside = false;  ///< scenes may show pictures from outside their folder
};

/// Opens the window and runs until it is closed. Returns the exit status. Throws Error if there is
/// no display or the file does not exist. A file that cannot be read is reported in the window.
int run_editor(const EditorOptions& options);

}  // namespace holomorph
