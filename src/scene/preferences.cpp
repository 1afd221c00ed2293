// Preferences are never worth an error on start: what cannot be read is left at its default.
#include "scene/preferences.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace holomorph {
namespace {

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

Path autosave_folder() {
  return folder("XDG_STATE_HOME", ".local/state") / "autosave";
}

Preferences load_preferences() {
  Preferences preferences;
  try {
    const auto json = nlohmann::json::parse(read_file(preferences_path()));
    preferences.light_theme = json.value("light_theme", false);
    const double scale = json.value("ui_scale", 0.0);
    preferences.ui_scale = scale > 0 ? std::clamp(scale, 0.75, 4.0) : 0.0;
    for (const auto& path : json.value("recent", std::vector<std::string>{}))
      preferences.recent.push_back(path);
  } catch (const std::exception&) {
    return Preferences{};
  }
  return preferences;
}

void save_preferences(const Preferences& preferences) {
  nlohmann::ordered_json json;
  json["light_theme"] = preferences.light_theme;
  json["ui_scale"] = preferences.ui_scale;
  json["recent"] = nlohmann::ordered_json::array();
  for (const Path& path : preferences.recent) json["recent"].push_back(path.string());
  std::error_code error;
  std::filesystem::create_directories(preferences_path().parent_path(), error);
  write_file(preferences_path(),
             json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void remember(Preferences& preferences, const Path& path) {
  std::erase(preferences.recent, path);
  preferences.recent.insert(preferences.recent.begin(), path);
  if (preferences.recent.size() > 10) preferences.recent.resize(10);
}

}  // namespace holomorph
