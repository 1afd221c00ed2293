// Paths are the subtle part: a scene names its picture relative to itself, so saving elsewhere
// rewrites the reference, and an autosave names it absolutely.
#include "scene/document.h"

#include <algorithm>
#include <chrono>
#include <random>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/json_reader.h"
#include "scene/formats/ora_image.h"
#include "scene/formats/scene_json.h"
#include "scene/laid_surface.h"
#include "scene/layers.h"
#include "scene/live_map.h"
#include "scene/preferences.h"

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

constexpr int kDeepestExtra = 1000;  // it was read from less

// An autosave remembers the file that its scene was opened from, under a key of its own.
constexpr const char *kOrigin = "autosave_of", *kOriginHash = "autosave_of_sha256";

/// A member of an object's text; "" without one.
std::string member_of(const Extra& extra, const char* key) {
  if (extra.empty()) return "";
  const JsonTree tree(extra, kDeepestExtra);
  const std::string name;
  const Reader reader(tree.root(), name, "");
  return reader.has(key) ? reader[key].text() : "";
}

Extra without_origin(const Extra& extra) {
  if (extra.empty()) return extra;
  const JsonTree tree(extra, kDeepestExtra);
  const std::string name;
  return Reader(tree.root(), name, "").others({kOrigin, kOriginHash});
}

Scene with_origin(Scene scene, const Path& origin, const std::string& sha256) {
  scene.extra = without_origin(scene.extra);
  if (origin.empty()) return scene;
  nlohmann::ordered_json json;
  json[kOrigin] = origin.string();
  json[kOriginHash] = sha256;
  const std::string ours = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  scene.extra =
      scene.extra.empty() ? ours : ours.substr(0, ours.size() - 1) + "," + scene.extra.substr(1);
  return scene;
}

/// Beside an autosave: locked while the program that writes it runs.
Path lock_path(const Path& autosave) {
  return Path(autosave).replace_extension(".lock");
}

/// The absolute path of what a scene file names.
Path beside(const Path& scene, const Path& file) {
  return absolute_path(file.is_absolute() ? file : scene.parent_path() / file);
}

/// The other way: relative to an absolute folder, as it is when that is empty.
std::string relative_to(const Path& folder, const Path& file) {
  const Path relative = folder.empty() ? Path() : file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.generic_string();
}

}  // namespace

namespace {

/// Every file that the layers of a scene name.
template <class Use>
void for_each_file(std::vector<Scene>& layers, Use use) {
  for (size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].image) use(layers[i].image->file);
    if (layers[i].surface) use(layers[i].surface->file);
  }
}

/// Lets a reference name the picture's namesake beside the scene when that is the picture.
void look_beside(const Path& scene, ImageReference& reference, const Reach& reach,
                 PictureFiles& files) {
  const Path name = Path(reference.file).filename();
  if (name.empty()) return;
  const Path moved = beside(scene, name);
  if (!reach.covers(moved, scene.parent_path())) return;
  try {
    if (files.sha256(moved.string()) == reference.sha256) reference.file = moved.string();
  } catch (const Error&) {
    // There is none either.
  }
}

/// Reads the picture of a layer. Returns what is to be said of it, such as that it is missing where
/// it may be.
std::string load_picture(Scene& layer, Pictures& pictures, PictureFiles& files, const Path& scene,
                         const std::string& pointer, const LoadOptions& options) {
  if (!layer.image) return "";
  ImageReference& reference = *layer.image;
  if (pictures.withheld().contains(reference.file))
    return "/image/file: " + reference.file + " is not in the scene's folder.";
  if (!is_there(reference.file)) look_beside(scene, reference, options.reach, files);
  try {
    if (!pictures.find(reference)) pictures.put(reference, files.picture(reference));
  } catch (const Error& error) {
    const std::string what = pointer + "/image/file: " + error.what();
    if (!options.pictures_may_be_missing) throw Error(error.kind(), what);
    return what;
  }
  const Picture& picture = *pictures.find(reference);
  const bool other = !reference.sha256.empty() && reference.sha256 != picture.sha256;
  reference = described(std::move(reference), picture);
  return other ? "The picture " + Path(reference.file).filename().string() +
                     " has changed since the scene was saved."
               : "";
}

}  // namespace

namespace {

/// Looked at before it is read, because a scene has a budget.
std::string read_scene_file(const Path& path) {
  std::error_code missing;
  const auto size = fs::file_size(path, missing);
  if (!missing)
    check_budget(&Budget::scene, static_cast<double>(size), path.string() + ": the scene has");
  return read_file(path);
}

}  // namespace

LoadedScene load_scene(const Path& path, const LoadOptions& options) {
  return scene_of_text(read_scene_file(path), path, options);
}

namespace {

/// Withholds what is out of a scene's reach, before anything is looked at; throws Error where it
/// must be there. A picture that lies beside the scene, too, is taken from there.
void keep_in_reach(std::vector<Scene>& layers, const Path& scene, const LoadOptions& options,
                   PictureFiles& files, Pictures& pictures) {
  const Path folder = scene.parent_path();
  for (size_t i = 0; i < layers.size(); ++i) {
    const std::string pointer =
        scene.string() + ": " + (layers.size() > 1 ? "/layers/" + std::to_string(i) : "");
    const auto withhold = [&](const std::string& file, const char* what) {
      if (!options.pictures_may_be_missing)
        throw Error(ErrorKind::bad_input,
                    pointer + what + ": " + file +
                        " is not in the scene's folder; use --allow-outside to "
                        "read it");
      pictures.withhold(file);
    };
    if (auto& image = layers[i].image; image && !options.reach.covers(image->file, folder)) {
      look_beside(scene, *image, options.reach, files);
      if (!options.reach.covers(image->file, folder)) withhold(image->file, "/image/file");
    }
    if (const auto& surface = layers[i].surface;
        surface && !options.reach.covers(surface->file, folder))
      withhold(surface->file, "/surface/file");
  }
}

}  // namespace

LoadedScene scene_of_text(const std::string& text, const Path& path, const LoadOptions& options) {
  LoadedScene loaded;
  loaded.sha256 = sha256_hex(text);
  const Scene scene = scene_from_json(text, path.string());
  PictureFiles files(options.open_pixels);
  std::vector<Scene> layers = layers_of(scene);
  try {
    check_affordable(layers);
  } catch (const Error& error) {
    throw about(path, error);
  }
  for_each_file(layers, [&](std::string& file) { file = beside(path, file).string(); });
  keep_in_reach(layers, path, options, files, loaded.pictures);
  for (size_t i = 0; i < layers.size(); ++i) {
    const std::string pointer =
        path.string() + ": " + (layers.size() > 1 ? "/layers/" + std::to_string(i) : "");
    const std::string warning =
        load_picture(layers[i], loaded.pictures, files, path, pointer, options);
    if (loaded.warning.empty()) loaded.warning = warning;
  }
  loaded.scene = scene_of_layers(std::move(layers), edited_layer(scene), scene);
  if (!options.recovers) loaded.scene.extra = without_origin(loaded.scene.extra);
  return loaded;
}

Sources sources_of(const Scene& scene, const Path& scene_path) {
  Sources sources{scene_path, {}, {}};
  for (size_t i = 0; i < layer_count(scene); ++i) {
    const Scene& layer = layer_at(scene, i);
    if (layer.image) sources.images.emplace_back(layer.image->file);
    if (layer.surface) sources.surfaces.emplace_back(layer.surface->file);
  }
  return sources;
}

void check_not_a_source(const Path& out, const Sources& sources) {
  const auto refuse_if = [&](const Path& source, const char* what) {
    std::error_code ignored;
    if (!source.empty() && fs::equivalent(out, source, ignored))
      throw Error(ErrorKind::bad_input,
                  out.string() + ": this is the " + what + "; choose another name");
  };
  refuse_if(sources.scene, "scene itself");
  for (const Path& image : sources.images) refuse_if(image, "picture that the scene bends");
  for (const Path& surface : sources.surfaces) refuse_if(surface, "surface that the scene covers");
}

void check_may_write(const Path& out, const Sources& sources) {
  check_not_a_source(out, sources);
  check_not_read_only(out);
}

namespace {

/// One layer with a picture of a file.
Scene layer_of_picture(const Path& file, const std::string& entry, PictureFiles& files,
                       Pictures& pictures) {
  const ImageReference wanted = reference_in(file, entry);
  Picture picture = files.picture(wanted);
  Scene layer;
  layer.image = described(wanted, picture);
  pictures.put(*layer.image, std::move(picture));
  return layer;
}

}  // namespace

LoadedScene scene_of_image(const Path& path, double open_pixels) {
  LoadedScene loaded;
  PictureFiles files(open_pixels);
  if (lower_case(path.extension().string()) != ".ora") {
    loaded.scene = layer_of_picture(path, "", files, loaded.pictures);
    return loaded;
  }
  std::vector<Scene> layers;
  for (const OraLayer& each : ora_layers(read_file(path), path.string())) {
    if (layers.size() == kMostLayers) {
      loaded.warning += "Only the lowest 100 layers were opened.";
      break;
    }
    Scene layer = layer_of_picture(path, each.entry, files, loaded.pictures);
    layer.layer.id = static_cast<int>(layers.size()) + 1;
    layer.layer.name = each.name;
    layer.layer.visible = each.visible;
    if (each.blended) loaded.warning = "The blending modes of this file's layers are not kept. ";
    layers.push_back(std::move(layer));
  }
  size_t edited = layers.size() - 1;
  while (edited > 0 && !layers[edited].layer.visible) --edited;
  loaded.scene = scene_of_layers(std::move(layers), edited, {});
  return loaded;
}

LoadedScene scene_of_pasted(const std::string& png) {
  decode_image(png, "the clipboard");
  if (pasted_folder().empty())
    throw Error(ErrorKind::failed,
                "Pasted pictures cannot be kept: this user has no home folder. Save the picture "
                "as a file and open that");
  std::error_code ignored;
  fs::create_directories(pasted_folder(), ignored);
  const Path file = pasted_folder() / (sha256_hex(png).substr(0, 16) + ".png");
  write_file(file, png);
  LoadedScene pasted = scene_of_image(file);
  pasted.scene.layer.name = "Pasted";
  return pasted;
}

LoadedScene scene_of_surface(const Path& obj, const Reach& reach) {
  const SurfaceFile file = surface_of_obj(read_file(obj), obj.string());
  const auto in_reach = [&](const Path& named) {
    if (reach.covers(named, obj.parent_path())) return named;
    throw Error(ErrorKind::bad_input, obj.string() + ": it names " + named.string() +
                                          ", which is not in its folder; put it there");
  };
  const auto texture = [&]() -> std::string {
    if (file.materials.empty()) return "";
    return texture_of_materials(read_file(in_reach(beside(obj, file.materials))));
  }();
  if (texture.empty())
    throw Error(ErrorKind::bad_input,
                obj.string() +
                    ": this surface has no picture on it. Open a picture, give it a cage and drop "
                    "the surface onto it");
  LoadedScene loaded = scene_of_image(in_reach(beside(beside(obj, file.materials), texture)));
  try {
    const Image& texture_image = *loaded.image();
    loaded.scene = with_cage(std::move(loaded.scene),
                             texture_boundary(file, texture_image.width, texture_image.height));
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
      pictures_(std::move(loaded.pictures)),
      path_(std::move(path)),
      saved_(loaded.scene),
      warning_(std::move(loaded.warning)),
      stamp_{{}, std::move(loaded.sha256)} {}

Document Document::open(const Path& path, const Reach& reach) {
  const std::string kind = lower_case(path.extension().string());
  if (is_scene_name(path)) return {load_scene(path, {true, reach}), absolute_path(path)};
  if (kind == ".obj") return {scene_of_surface(path, reach), Path()};
  return {scene_of_image(path), Path()};
}

Document Document::copy_of(const Path& scene) {
  return {load_scene(scene, {false, {true}}), Path()};
}

Document Document::recover(const Path& autosave) {
  LoadOptions options{true, {true}};
  options.recovers = true;
  Document document(load_scene(autosave, options), Path());
  Scene scene = document.scene();
  document.path_ = member_of(scene.extra, kOrigin);
  document.stamp_ = {{}, member_of(scene.extra, kOriginHash)};
  scene.extra = without_origin(scene.extra);
  document.history_ = History(scene, "Recovered");
  document.saved_ = Scene{};
  return document;
}

bool Document::changed_on_disk() {
  std::error_code error;
  const auto time = fs::last_write_time(path_, error);
  if (error || stamp_.sha256.empty() || time == stamp_.time) return false;
  try {
    if (sha256_hex(read_scene_file(path_)) != stamp_.sha256) return true;
  } catch (const Error&) {
    return true;
  }
  stamp_.time = time;  // touched, and the same
  return false;
}

std::vector<Path> Document::withheld() const {
  return {pictures_.withheld().begin(), pictures_.withheld().end()};
}

std::string Document::title() const {
  if (!path_.empty()) return path_.filename().string();
  const Path source = first_picture();
  return source.empty() ? "Untitled" : source.stem().string() + " (not saved)";
}

Path Document::first_picture() const {
  for (size_t i = 0; i < layer_count(scene()); ++i)
    if (const auto& image = layer_at(scene(), i).image) return image->file;
  return {};
}

std::vector<size_t> Document::without_picture() const {
  std::vector<size_t> layers;
  for (size_t i = 0; i < layer_count(scene()); ++i)
    if (const Scene& layer = layer_at(scene(), i); layer.image && !pictures_.of(layer))
      layers.push_back(i);
  return layers;
}

Sources Document::sources() const {
  return sources_of(scene(), path_);
}

bool Document::commit(const std::string& label, Scene scene, std::optional<double> at) {
  return history_.commit(label, std::move(scene), at);
}

Scene portable(Scene scene, const Path& folder) {
  std::vector<Scene> layers = layers_of(scene);
  for_each_file(layers, [&](std::string& file) { file = relative_to(folder, file); });
  return scene_of_layers(std::move(layers), edited_layer(scene), scene);
}

namespace {

/// With the pictures as they are now, and copies of pasted ones beside the scene.
Scene with_present_pictures(const Scene& scene, Pictures& pictures, const Path& target) {
  std::vector<Scene> layers = layers_of(scene);
  for (Scene& layer : layers) {
    if (!layer.image) continue;
    ImageReference& image = *layer.image;
    if (const Picture* now = pictures.find(image)) image = described(image, *now);
    const Path file = image.file;
    const Picture* picture = pictures.find(image);
    if (file.parent_path() != pasted_folder() || !picture) continue;
    const Path copy =
        target.parent_path() / (target.stem().string() + "-" + file.stem().string() + ".png");
    // What was pasted is known by its contents: a copy that is there is this one.
    if (!is_there(copy)) write_file(copy, encode_png(*picture->image));
    Picture copied = *picture;
    std::error_code ignored;
    copied.changed = fs::last_write_time(copy, ignored);
    image.file = copy.string();
    pictures.put(image, std::move(copied));
  }
  return scene_of_layers(std::move(layers), edited_layer(scene), scene);
}

}  // namespace

void Document::save(const Path& path) {
  const Path target = absolute_path(path);
  check_not_read_only(target);
  Scene present = with_present_pictures(scene(), pictures_, target);
  const std::string text = json_of(portable(present, target.parent_path()));
  write_file(target, text);
  history_.replace(std::move(present));
  path_ = target;
  stamp_ = {{}, sha256_hex(text)};
  saved_ = history_.current();
  unsaved_ = false;
}

bool Document::autosave(const Path& folder) {
  if (!modified() && autosaved_) remove_autosave(folder);
  if (!modified() || autosaved_ == scene()) return true;
  if (folder.empty()) return false;
  const Path path = autosave_path(folder, id_);
  std::error_code ignored;
  if (!lock_) {
    fs::create_directories(folder, ignored);
    fs::permissions(folder, fs::perms::owner_all, ignored);  // it is nobody else's business
  }
  try {
    if (!lock_) lock_ = std::make_shared<FileLock>(lock_path(path));
    write_file(path, json_of(with_origin(portable(scene(), Path()), path_, stamp_.sha256)),
               NewFile::Readers::owner);
  } catch (const Error&) {
    return false;
  }
  autosaved_ = scene();
  return true;
}

void Document::remove_autosave(const Path& folder) {
  autosaved_.reset();
  if (folder.empty()) return;
  std::error_code ignored;
  fs::remove(autosave_path(folder, id_), ignored);
  lock_.reset();
}

namespace {

/// "hero.json, 30 cage points, 4 pins, 5 minutes ago".
Recovery recovery_of(const Path& autosave, fs::file_time_type time) {
  Recovery recovery{autosave, "a scene", {}};
  std::string& name = recovery.label;
  try {
    const Scene scene = scene_from_json(read_scene_file(autosave), autosave.string());
    const Path& origin = recovery.origin = member_of(scene.extra, kOrigin);
    if (!origin.empty())
      name = (origin.parent_path().filename() / origin.filename()).string();
    else if (scene.image)
      name = Path(scene.image->file).stem().string() + " (never saved)";
    size_t points = 0, pins = 0;
    for (size_t i = 0; i < layer_count(scene); ++i) {
      points += static_cast<size_t>(layer_at(scene, i).rest.size());
      pins += layer_at(scene, i).pins.size();
    }
    if (layer_count(scene) > 1) name += ", " + std::to_string(layer_count(scene)) + " layers";
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
