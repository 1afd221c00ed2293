// Preferences that are saved between sessions, and the locations of the program's own files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "system/file.h"

namespace holomorph {

/// Maps the id of an action to the names of the keys that trigger it.
using KeyNames = std::map<std::string, std::vector<std::string>>;

enum class Theme { dark, light, contrast };

struct Preferences {
  Theme theme = Theme::dark;
  double ui_scale = 0;         ///< 0: the scale of the display
  bool native_dialogs = true;  ///< use the desktop's file dialogs, if available
  bool hints = true;           ///< show hints for the first steps
  bool reduce_motion = false;  ///< no fades and no moving previews
  /// Which sections of the inspector are open, by title. Others have their usual state.
  std::map<std::string, bool> sections = {};
  KeyNames keys;  ///< only actions whose keys differ from the defaults
  std::vector<Path> recent;
  std::vector<Path> trusted = {};  ///< any scene may use the files in these folders
  bool operator==(const Preferences&) const = default;
};

/// Reads $XDG_CONFIG_HOME/holomorph/preferences.json. Returns the defaults if the file is missing
/// or damaged.
Preferences load_preferences();
/// Reads preferences from a text. The result is valid for any text.
Preferences preferences_of_json(const std::string& text);
/// Writes the preferences. Throws Error{failed} if this is not possible.
void save_preferences(const Preferences& preferences);
/// Moves a path to the front of the list of recent files, which is limited to ten.
void remember(Preferences& preferences, const Path& path);

/// Converts key assignments to JSON text for export, and back for import. keys_of_json throws
/// Error{bad_input} if the text is not a file of keys. `name` is used in the message.
std::string json_of_keys(const KeyNames& keys);
KeyNames keys_of_json(const std::string& text, const std::string& name);

/// $XDG_STATE_HOME/holomorph/autosave; empty if the user has no home folder.
Path autosave_folder();
/// $XDG_STATE_HOME/holomorph/pictures, for the last pictures of scenes; empty if the user has no
/// home folder.
Path last_picture_folder();
/// $XDG_DATA_HOME/holomorph/pasted, for pictures that did not come from a file; empty if the user
/// has no home folder.
Path pasted_folder();

}  // namespace holomorph
