// The only place that joins the editor and the window.
#include "app/run_editor.h"

#include <utility>

#include "app/editor.h"
#include "app/window.h"
#include "core/error.h"

namespace holomorph {

int run_editor(const EditorOptions& options) {
  if (!options.file.empty() && !path_exists(options.file))
    throw Error(ErrorKind::bad_input,
                options.file.string() + ": no such file or command. See 'holomorph --help'");
  if (!has_display())
    throw Error(ErrorKind::failed,
                "cannot open a window: there is no display. 'holomorph render SCENE --out "
                "PICTURE.png' works without one");
  Preferences preferences = load_preferences();
  Window window(1280, 800, preferences);
  Editor editor(window, std::move(preferences), options);
  while (editor.step()) {
  }
  return 0;
}

}  // namespace holomorph
