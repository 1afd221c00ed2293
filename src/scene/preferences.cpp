// Preferences are never worth an error on start: what cannot be read is left at its default.
#include "scene/preferences.h"

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace holomorph {
namespace {

constexpr std::array<const char*, 3> kThemes{"dark", "light", "contrast"};

Path folder(const char* variable, const char* fallback) {
  const char* set = std::getenv(variable);
  if (set && *set) return Path(set) / "holomorph";
  const char* home = std::getenv("HOME");
  return Path(home && *home ? home : "/tmp") / fallback / "holomorph";
}

Path preferences_path() {
  return folder("XDG_CONFIG_HOME", ".config") / "preferences.json";
}

}  // namespace

Path pasted_folder() {
  return std::filesystem::absolute(folder("XDG_DATA_HOME", ".local/share") / "pasted")
      .lexically_normal();
}

Path autosave_folder() {
  return folder("XDG_STATE_HOME", ".local/state") / "autosave";
}

Preferences load_preferences() {
  Preferences preferences;
  try {
    const auto json = nlohmann::json::parse(read_file(preferences_path()));
    const std::string theme = json.value("theme", json.value("light_theme", false) ? "light" : "");
    for (size_t i = 0; i < kThemes.size(); ++i)
      if (theme == kThemes[i]) preferences.theme = static_cast<Theme>(i);
    preferences.native_dialogs = json.value("native_dialogs", true);
    preferences.hints = json.value("hints", true);
    const double scale = json.value("ui_scale", 0.0);
    preferences.ui_scale = scale > 0 ? std::clamp(scale, 0.75, 4.0) : 0.0;
    for (const auto& path : json.value("recent", std::vector<std::string>{}))
      preferences.recent.push_back(path);
    // Last, so that nothing else is lost with it.
    preferences.keys = json.value("keys", KeyNames{});
  } catch (const std::exception&) {
    // What was read so far is good.
  }
  return preferences;
}

void save_preferences(const Preferences& preferences) {
  nlohmann::ordered_json json;
  json["theme"] = kThemes[static_cast<size_t>(preferences.theme)];
  json["native_dialogs"] = preferences.native_dialogs;
  json["hints"] = preferences.hints;
  json["keys"] = preferences.keys;
  json["ui_scale"] = preferences.ui_scale;
  json["recent"] = nlohmann::ordered_json::array();
  for (const Path& path : preferences.recent) json["recent"].push_back(path.string());
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
    // The same message: it is no such file.
  }
  throw Error(ErrorKind::bad_input,
              name + ": these are no keys; a file of 'Keys and mouse > Export' is wanted");
}

void remember(Preferences& preferences, const Path& path) {
  std::erase(preferences.recent, path);
  preferences.recent.insert(preferences.recent.begin(), path);
  if (preferences.recent.size() > 10) preferences.recent.resize(10);
}

}  // namespace holomorph
