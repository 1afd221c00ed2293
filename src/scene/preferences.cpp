// Damaged preferences are not an error. A setting that cannot be read gets its default value.
#include "scene/preferences.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

constexpr std::array<const char*, 3> kThemes{"dark", "light", "contrast"};

/// The user's home folder, from the environment or the system; empty if there is none.
Path home() {
  const char* set = std::getenv("HOME");
  if (set && *set) return set;
  passwd entry{}, *found = nullptr;
  char names[4096];
  ::getpwuid_r(::getuid(), &entry, names, sizeof names, &found);
  return found && found->pw_dir ? Path(found->pw_dir) : Path();
}

Path folder(const char* variable, const char* fallback) {
  const char* set = std::getenv(variable);
  if (set && *set) return Path(set) / "holomorph";
  const Path at = home();
  return at.empty() ? at : at / fallback / "holomorph";
}

Path in_folder(const char* variable, const char* fallback, const char* name) {
  const Path at = folder(variable, fallback);
  return at.empty() ? at : absolute_path(at / name);
}

Path preferences_path() {
  return in_folder("XDG_CONFIG_HOME", ".config", "preferences.json");
}

/// The value of a member if it has the expected type, or else a default.
template <class T>
T member(const nlohmann::json& json, const char* key, T otherwise) {
  try {
    return json.value(key, otherwise);
  } catch (const nlohmann::json::exception&) {
    return otherwise;
  }
}

/// The absolute paths in a list, without repetitions. Invalid paths are left out.
std::vector<Path> paths_in(const nlohmann::json& json, const char* key, size_t most) {
  std::vector<Path> paths;
  for (const std::string& text : member(json, key, std::vector<std::string>{})) {
    constexpr size_t kLongest = 4096;
    if (text.empty() || text.size() > kLongest || text.find('\0') != std::string::npos) continue;
    if (!Path(text).is_absolute() || paths.size() == most) continue;
    if (std::ranges::find(paths, Path(text)) == paths.end()) paths.emplace_back(text);
  }
  return paths;
}

constexpr size_t kMostRecent = 10, kMostTrusted = 200;

}  // namespace

Path pasted_folder() {
  return in_folder("XDG_DATA_HOME", ".local/share", "pasted");
}

Path autosave_folder() {
  return in_folder("XDG_STATE_HOME", ".local/state", "autosave");
}

Path last_picture_folder() {
  return in_folder("XDG_STATE_HOME", ".local/state", "pictures");
}

Preferences preferences_of_json(const std::string& text) {
  Preferences preferences;
  constexpr size_t kLargest = 1 << 20;
  if (text.size() > kLargest) return preferences;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return preferences;
  const std::string theme =
      member(json, "theme", std::string(member(json, "light_theme", false) ? "light" : ""));
  for (size_t i = 0; i < kThemes.size(); ++i)
    if (theme == kThemes[i]) preferences.theme = static_cast<Theme>(i);
  preferences.native_dialogs = member(json, "native_dialogs", true);
  preferences.hints = member(json, "hints", true);
  const double scale = member(json, "ui_scale", 0.0);
  preferences.ui_scale = scale > 0 ? std::clamp(scale, 0.75, 4.0) : 0.0;
  preferences.recent = paths_in(json, "recent", kMostRecent);
  preferences.trusted = paths_in(json, "trusted", kMostTrusted);
  preferences.keys = member(json, "keys", KeyNames{});
  preferences.reduce_motion = member(json, "reduce_motion", false);
  constexpr size_t kMostSections = 20;
  for (const auto& [title, open] : member(json, "sections", std::map<std::string, bool>{}))
    if (preferences.sections.size() < kMostSections && title.size() < 64)
      preferences.sections[title] = open;
  return preferences;
}

Preferences load_preferences() {
  try {
    return preferences_of_json(read_file(preferences_path()));
  } catch (const Error&) {
    return {};  // no preferences have been saved yet
  }
}

void save_preferences(const Preferences& preferences) {
  nlohmann::ordered_json json;
  json["theme"] = kThemes[static_cast<size_t>(preferences.theme)];
  json["native_dialogs"] = preferences.native_dialogs;
  json["hints"] = preferences.hints;
  json["reduce_motion"] = preferences.reduce_motion;
  json["sections"] = preferences.sections;
  json["keys"] = preferences.keys;
  json["ui_scale"] = preferences.ui_scale;
  json["recent"] = nlohmann::ordered_json::array();
  for (const Path& path : preferences.recent) json["recent"].push_back(path.string());
  if (!preferences.trusted.empty()) json["trusted"] = nlohmann::ordered_json::array();
  for (const Path& path : preferences.trusted) json["trusted"].push_back(path.string());
  if (preferences_path().empty())
    throw Error(ErrorKind::failed,
                "Preferences cannot be saved because this user has no home folder");
  std::error_code error;
  std::filesystem::create_directories(preferences_path().parent_path(), error);
  write_file(preferences_path(),
             json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::string json_of_keys(const KeyNames& keys) {
  nlohmann::ordered_json json;
  json["format"] = "holomorph-keys";
  json["keys"] = keys;
  return json.dump(2) + "\n";
}

KeyNames keys_of_json(const std::string& text, const std::string& name) {
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.value("format", "") == "holomorph-keys") return json.at("keys").get<KeyNames>();
  } catch (const nlohmann::json::exception&) {
    // Falls through to the error below.
  }
  throw Error(ErrorKind::bad_input,
              name + ": not a file of keys; choose a file written by 'Keys and mouse > Export'");
}

void remember(Preferences& preferences, const Path& path) {
  std::erase(preferences.recent, path);
  preferences.recent.insert(preferences.recent.begin(), path);
  if (preferences.recent.size() > kMostRecent) preferences.recent.resize(kMostRecent);
}

}  // namespace holomorph
