// What the program remembers between sessions, and where its own files lie.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "system/file.h"

namespace holomorph {

/// Keys in words by the ids of what they do.
using KeyNames = std::map<std::string, std::vector<std::string>>;

enum class Theme { dark, light, contrast };

struct Preferences {
  Theme theme = Theme::dark;
  double ui_scale = 0;         ///< 0: the display's
  bool native_dialogs = true;  ///< where the desktop has any
  bool hints = true;           ///< the first steps are shown
  KeyNames keys;               ///< that differ from the program's own
  std::vector<Path> recent;
  std::vector<Path> trusted = {};  ///< folders whose files any scene may show
  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/holomorph/preferences.json. A missing or damaged file gives the defaults.
Preferences load_preferences();
/// The same of a text; whatever it is, what comes of it can be used.
Preferences preferences_of_json(const std::string& text);
/// Throws Error{failed} when they cannot be written.
void save_preferences(const Preferences& preferences);
/// Puts a path first among the recent ones, which stay at most ten.
void remember(Preferences& preferences, const Path& path);

/// Keys as JSON text, for exchange, and back. Throws Error{bad_input} naming what is wrong.
std::string json_of_keys(const KeyNames& keys);
KeyNames keys_of_json(const std::string& text, const std::string& name);

/// $XDG_STATE_HOME/holomorph/autosave. Like the next one empty where the user has no home folder.
Path autosave_folder();
/// $XDG_DATA_HOME/holomorph/pasted: pictures that came from no file.
Path pasted_folder();

}  // namespace holomorph
