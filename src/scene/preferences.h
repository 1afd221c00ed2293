// What the program remembers between sessions, and the locations of its own files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "system/file.h"

namespace holomorph {

/// The names of keys, by the ids of the actions that they trigger.
using KeyNames = std::map<std::string, std::vector<std::string>>;

enum class Theme { dark, light, contrast };

struct Preferences {
  Theme theme = Theme::dark;
  double ui_scale = 0;         ///< 0: the scale of the display
  bool native_dialogs = true;  ///< if the desktop has any
  bool hints = true;           ///< show the first steps
  KeyNames keys;               ///< only those that differ from the program's defaults
  std::vector<Path> recent;
  std::vector<Path> trusted = {};  ///< folders whose files any scene may use
  bool operator==(const Preferences&) const = default;
};

/// Reads $XDG_CONFIG_HOME/holomorph/preferences.json. A missing or damaged file gives the defaults.
Preferences load_preferences();
/// The same for a text. The result is valid for any text.
Preferences preferences_of_json(const std::string& text);
/// Throws Error{failed} if they cannot be written.
void save_preferences(const Preferences& preferences);
/// Moves a path to the front of the recent files, of which at most ten are kept.
void remember(Preferences& preferences, const Path& path);

/// Converts keys to JSON text, for exchange, and back. keys_of_json throws Error{bad_input} that
/// says what is wrong.
std::string json_of_keys(const KeyNames& keys);
KeyNames keys_of_json(const std::string& text, const std::string& name);

/// $XDG_STATE_HOME/holomorph/autosave; empty if the user has no home folder.
Path autosave_folder();
/// $XDG_DATA_HOME/holomorph/pasted, for pictures that did not come from a file; empty if the user
/// has no home folder.
Path pasted_folder();

}  // namespace holomorph
