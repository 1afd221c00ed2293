// An autosave file also stores its origin, so the only additional file is the lock.
#include "scene/recovery.h"

#include <algorithm>
#include <chrono>

#include "scene/formats/json_reader.h"
#include "scene/formats/scene_json.h"
#include "scene/loading.h"
#include "system/new_file.h"

namespace holomorph {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepestExtra = 1000;  // deeper than any scene that can be read

constexpr const char *kOrigin = "autosave_of", *kOriginHash = "autosave_of_sha256";

/// The text of a member of a JSON object; "" if there is no such member.
std::string member_of(const Extra& extra, const char* key) {
  if (extra.empty()) return "";
  const JsonTree tree(extra, kDeepestExtra);
  const std::string name;
  const Reader reader(tree.root(), name, "");
  return reader.has(key) ? reader[key].text() : "";
}

}  // namespace

Path autosave_path(const Path& folder, const std::string& id) {
  return folder / (id + ".json");
}

Path lock_path(const Path& autosave) {
  return Path(autosave).replace_extension(".lock");
}

Scene without_origin(Scene scene) {
  if (scene.extra.empty()) return scene;
  const JsonTree tree(scene.extra, kDeepestExtra);
  const std::string name;
  scene.extra = Reader(tree.root(), name, "").others({kOrigin, kOriginHash});
  return scene;
}

Scene with_origin(Scene scene, const Origin& origin) {
  scene = without_origin(std::move(scene));
  if (origin.file.empty()) return scene;
  Json json;
  json[kOrigin] = origin.file.string();
  json[kOriginHash] = origin.sha256;
  const std::string ours = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  scene.extra =
      scene.extra.empty() ? ours : ours.substr(0, ours.size() - 1) + "," + scene.extra.substr(1);
  return scene;
}

Origin origin_of(const Scene& scene) {
  return {member_of(scene.extra, kOrigin), member_of(scene.extra, kOriginHash)};
}

namespace {

/// Describes an autosave, such as "art/hero.json, 30 cage points, 4 pins, 5 minutes ago".
Recovery recovery_of(const Path& autosave, fs::file_time_type time) {
  Recovery recovery{autosave, "a scene", {}};
  std::string& name = recovery.label;
  try {
    const Scene scene = scene_from_json(read_scene_file(autosave), autosave.string());
    const Path& origin = recovery.origin = origin_of(scene).file;
    if (!origin.empty())
      name = (origin.parent_path().filename() / origin.filename()).string();
    else if (const auto& image = scene.layer().image)
      name = Path(image->file).stem().string() + " (never saved)";
    size_t points = 0, pins = 0;
    for (const SharedLayer& layer : scene.layers) {
      points += static_cast<size_t>(layer->deformation.rest.size());
      pins += layer->deformation.pins.size();
    }
    if (scene.layers.size() > 1) name += ", " + std::to_string(scene.layers.size()) + " layers";
    name += ", " + std::to_string(points) + " cage points, " + std::to_string(pins) +
            (pins == 1 ? " pin" : " pins");
  } catch (const std::exception&) {
    name = "a damaged scene";
  }
  const auto age =
      std::chrono::duration_cast<std::chrono::minutes>(fs::file_time_type::clock::now() - time)
          .count();
  name += age < 2      ? ", just now"
          : age < 120  ? ", " + std::to_string(age) + " minutes ago"
          : age < 2880 ? ", " + std::to_string(age / 60) + " hours ago"
                       : ", " + std::to_string(age / 1440) + " days ago";
  return recovery;
}

}  // namespace

std::vector<Recovery> recoverable(const Path& folder) {
  std::vector<std::pair<fs::file_time_type, Path>> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const Path& path = entry->path();
    if (path.extension() != ".json" || path.filename().string().starts_with(".")) continue;
    if (!FileLock::is_held(lock_path(path))) found.push_back({entry->last_write_time(error), path});
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<Recovery> recoveries;
  for (const auto& [time, path] : found) recoveries.push_back(recovery_of(path, time));
  return recoveries;
}

void discard(const Path& autosave) {
  std::error_code ignored;
  fs::remove(autosave, ignored);
  fs::remove(lock_path(autosave), ignored);
}

}  // namespace holomorph
