// What the program remembers between sessions, and where its own files lie.
#pragma once

#include <vector>

#include "scene/file.h"

namespace holomorph {

struct Preferences {
  bool light_theme = false;
  double ui_scale = 0;  ///< 0: the display's
  std::vector<Path> recent;
  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/holomorph/preferences.json. A missing or damaged file gives the defaults.
Preferences load_preferences();
/// Throws Error{failed} when they cannot be written.
void save_preferences(const Preferences& preferences);
/// Puts a path first among the recent ones, which stay at most ten.
void remember(Preferences& preferences, const Path& path);

/// $XDG_STATE_HOME/holomorph/autosave.
Path autosave_folder();

}  // namespace holomorph
