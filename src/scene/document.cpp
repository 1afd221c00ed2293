// Paths are the subtle part: a scene names its picture relative to itself, so saving elsewhere
// rewrites the reference, and an autosave names it absolutely.
#include "scene/document.h"

#include <algorithm>
#include <chrono>
#include <random>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/laid_surface.h"
#include "scene/scene_json.h"

namespace holomorph {
namespace fs = std::filesystem;
namespace {

std::string fresh_id() {
  std::random_device random;
  char text[24];
  std::snprintf(text, sizeof text, "%08x%08x", random(), random());
  return text;
}

Path autosave_path(const Path& folder, const std::string& id) {
  return folder / (id + ".json");
}

// An autosave remembers the file that its scene was opened from, under a key of its own.
constexpr const char* kOrigin = "autosave_of";

std::string with_origin(const std::string& json, const Path& origin) {
  if (origin.empty()) return json;
  nlohmann::ordered_json value = nlohmann::ordered_json::parse(json);
  value[kOrigin] = origin.string();
  return value.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Path origin_of(const std::string& json) {
  const auto value = nlohmann::json::parse(json, nullptr, false);
  return value.is_object() && value.contains(kOrigin) && value[kOrigin].is_string()
             ? Path(value[kOrigin].get<std::string>())
             : Path();
}

Extra without_origin(const Extra& extra) {
  if (extra.empty()) return extra;
  auto value = nlohmann::ordered_json::parse(extra);
  value.erase(kOrigin);
  return value.empty() ? "" : value.dump();
}

/// Beside an autosave: locked while the program that writes it runs.
Path lock_path(const Path& autosave) {
  return Path(autosave).replace_extension(".lock");
}

/// The absolute path of what a scene file names.
Path beside(const Path& scene, const Path& file) {
  return fs::absolute(file.is_absolute() ? file : scene.parent_path() / file).lexically_normal();
}

/// The other way: relative to an absolute folder, as it is when that is empty.
std::string relative_to(const Path& folder, const Path& file) {
  const Path relative = folder.empty() ? Path() : file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.generic_string();
}

}  // namespace

Path image_path_of(const Scene& scene, const Path& scene_path) {
  if (!scene.image) return {};
  return beside(scene_path, scene.image->file);
}

LoadedScene load_scene(const Path& path) {
  LoadedScene loaded;
  loaded.scene = scene_from_json(read_file(path), path.string());
  if (auto& surface = loaded.scene.surface) surface->file = beside(path, surface->file).string();
  if (!loaded.scene.image) return loaded;
  const Path image_path = image_path_of(loaded.scene, path);
  const std::string pointer = path.string() + ": /image/file: ";
  try {
    const std::string bytes = read_file(image_path);
    loaded.image = std::make_shared<const Image>(decode_image(bytes, image_path.string()));
    ImageReference& reference = *loaded.scene.image;
    if (!reference.sha256.empty() && reference.sha256 != sha256_hex(bytes))
      loaded.warning = "The picture " + reference.file + " has changed since the scene was saved.";
    reference.sha256 = sha256_hex(bytes);
    reference.width = loaded.image->width;
    reference.height = loaded.image->height;
  } catch (const Error& error) {
    throw Error(error.kind(), pointer + error.what());
  }
  return loaded;
}

Sources sources_of(const Scene& scene, const Path& scene_path) {
  return {scene_path, image_path_of(scene, scene_path),
          scene.surface ? Path(scene.surface->file) : Path()};
}

void check_not_a_source(const Path& out, const Sources& sources) {
  std::error_code ignored;
  for (const auto& [source, what] : {std::pair(sources.scene, "scene itself"),
                                     std::pair(sources.image, "picture that the scene bends"),
                                     std::pair(sources.surface, "surface that the scene covers")})
    if (!source.empty() && fs::equivalent(out, source, ignored))
      throw Error(ErrorKind::bad_input,
                  out.string() + ": this is the " + what + "; choose another name");
}

LoadedScene scene_of_image(const Path& path) {
  const std::string bytes = read_file(path);
  LoadedScene loaded;
  loaded.image = std::make_shared<const Image>(decode_image(bytes, path.string()));
  loaded.scene.image = ImageReference{fs::absolute(path).string(), loaded.image->width,
                                      loaded.image->height, sha256_hex(bytes), ""};
  return loaded;
}

LoadedScene scene_of_surface(const Path& obj) {
  const SurfaceFile file = surface_of_obj(read_file(obj), obj.string());
  const auto texture = [&]() -> std::string {
    if (file.materials.empty()) return "";
    return texture_of_materials(read_file(beside(obj, file.materials)));
  }();
  if (texture.empty())
    throw Error(ErrorKind::bad_input,
                obj.string() +
                    ": this surface has no picture on it. Open a picture, give it a cage and drop "
                    "the surface onto it");
  LoadedScene loaded = scene_of_image(beside(beside(obj, file.materials), texture));
  try {
    loaded.scene = with_cage(std::move(loaded.scene),
                             texture_boundary(file, loaded.image->width, loaded.image->height));
    check_rest_cage(loaded.scene.rest);
  } catch (const Error& error) {
    throw about(obj, error);
  }
  return loaded;
}

bool is_scene_name(const Path& path) {
  const std::string kind = lower_case(path.extension().string());
  return kind == ".json" || kind == ".holomorph";
}

Document::Document() : id_(fresh_id()), history_(Scene{}, "New") {}

Document::Document(LoadedScene loaded, Path path)
    : id_(fresh_id()),
      history_(loaded.scene),
      image_(std::move(loaded.image)),
      image_path_(image_path_of(loaded.scene, path)),
      path_(std::move(path)),
      saved_(loaded.scene),
      warning_(std::move(loaded.warning)) {}

Document Document::open(const Path& path) {
  const std::string kind = lower_case(path.extension().string());
  if (is_scene_name(path)) return {load_scene(path), fs::absolute(path).lexically_normal()};
  if (kind == ".obj") return {scene_of_surface(path), Path()};
  return {scene_of_image(path), Path()};
}

Document Document::copy_of(const Path& scene) {
  Document document(load_scene(scene), Path());
  document.image_path_ = image_path_of(document.scene(), scene);
  return document;
}

Document Document::recover(const Path& autosave) {
  Document document(load_scene(autosave), Path());
  document.image_path_ = image_path_of(document.scene(), autosave);
  document.path_ = origin_of(read_file(autosave));
  Scene scene = document.scene();
  scene.extra = without_origin(scene.extra);
  document.history_ = History(scene, "Recovered");
  document.saved_ = Scene{};
  return document;
}

std::string Document::title() const {
  if (!path_.empty()) return path_.filename().string();
  return image_path_.empty() ? "Untitled" : image_path_.stem().string() + " (not saved)";
}

Sources Document::sources() const {
  return {path_, image_path_, scene().surface ? Path(scene().surface->file) : Path()};
}

bool Document::commit(const std::string& label, Scene scene, std::optional<double> at) {
  return history_.commit(label, std::move(scene), at);
}

Scene portable(Scene scene, const Path& image, const Path& folder) {
  if (scene.image && !image.empty()) scene.image->file = relative_to(folder, image);
  if (scene.surface) scene.surface->file = relative_to(folder, scene.surface->file);
  return scene;
}

void Document::save(const Path& path) {
  const Path target = fs::absolute(path).lexically_normal();
  write_file(target, json_of(portable(scene(), image_path_, target.parent_path())));
  path_ = target;
  saved_ = history_.current();
}

bool Document::autosave(const Path& folder) {
  if (!modified() && autosaved_) remove_autosave(folder);
  if (!modified() || autosaved_ == scene()) return true;
  const Path path = autosave_path(folder, id_);
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  try {
    if (!lock_) lock_ = std::make_shared<FileLock>(lock_path(path));
    write_file(path, with_origin(json_of(portable(scene(), image_path_, Path())), path_));
  } catch (const Error&) {
    return false;
  }
  autosaved_ = scene();
  return true;
}

void Document::remove_autosave(const Path& folder) {
  autosaved_.reset();
  std::error_code ignored;
  fs::remove(autosave_path(folder, id_), ignored);
  lock_.reset();
}

namespace {

/// "hero.json, 30 cage points, 4 pins, 5 minutes ago".
std::string label_of(const Path& autosave, fs::file_time_type time) {
  std::string name = "a scene";
  try {
    const std::string text = read_file(autosave);
    const Scene scene = scene_from_json(text, autosave.string());
    const Path origin = origin_of(text);
    if (!origin.empty())
      name = origin.filename().string();
    else if (scene.image)
      name = Path(scene.image->file).stem().string() + " (never saved)";
    name += ", " + std::to_string(scene.rest.size()) + " cage points, " +
            std::to_string(scene.pins.size()) + (scene.pins.size() == 1 ? " pin" : " pins");
  } catch (const Error&) {
    name = "a damaged scene";
  }
  const auto age =
      std::chrono::duration_cast<std::chrono::minutes>(fs::file_time_type::clock::now() - time)
          .count();
  if (age < 2) return name + ", just now";
  if (age < 120) return name + ", " + std::to_string(age) + " minutes ago";
  if (age < 2880) return name + ", " + std::to_string(age / 60) + " hours ago";
  return name + ", " + std::to_string(age / 1440) + " days ago";
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
  for (const auto& [time, path] : found) recoveries.push_back({path, label_of(path, time)});
  return recoveries;
}

void discard(const Path& autosave) {
  std::error_code ignored;
  fs::remove(autosave, ignored);
  fs::remove(lock_path(autosave), ignored);
}

}  // namespace holomorph
