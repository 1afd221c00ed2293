// The editor: a window around a workspace.
#pragma once

#include "system/file.h"

namespace holomorph {

struct EditorOptions {
  Path file;        ///< a scene or picture to open; empty: the welcome page
  Path state_file;  ///< when set, what the editor shows is written here whenever it changes
  bool allow_outside = false;  ///< scenes may show pictures that are not in their folder
};

/// Opens the window and runs until it is closed. Returns the exit status. Throws Error when there
/// is no display or no such file; a file that cannot be read is a message in the window.
int run_editor(const EditorOptions& options);

}  // namespace holomorph
