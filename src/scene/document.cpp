// A saved scene has paths relative to its folder. An autosave has absolute paths.
#include "scene/document.h"

#include <map>
#include <random>
#include <set>

#include "core/error.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/scene_json.h"
#include "scene/preferences.h"
#include "scene/recovery.h"
#include "system/new_file.h"

namespace holomorph {
namespace fs = std::filesystem;
namespace {

std::string fresh_id() {
  std::random_device random;
  char text[24];
  std::snprintf(text, sizeof text, "%08x%08x", random(), random());
  return text;
}

}  // namespace

Document::Document() : id_(fresh_id()), history_(Scene{}, "New") {}

Document::Document(LoadedScene loaded, Path path)
    : id_(fresh_id()),
      history_(loaded.scene),
      pictures_(std::move(loaded.pictures)),
      path_(std::move(path)),
      saved_(loaded.scene),
      warning_(loaded.message(LoadedScene::kFewLines)),
      stamp_{{}, std::move(loaded.sha256)} {}

Document Document::open(const Path& path, const Reach& reach) {
  if (is_named_as(path, FileContent::scene))
    return {load_scene(path, {true, reach}), absolute_path(path)};
  if (is_named_as(path, FileContent::surface)) return {scene_of_surface(path, reach), Path()};
  return {scene_of_image(path), Path()};
}

Document Document::copy_of(const Path& scene) {
  return {load_scene(scene, {false, {true}}), Path()};
}

Document Document::recover(const Path& autosave) {
  LoadOptions options{true, {true}};
  options.keeps_origin = true;
  Document document(load_scene(autosave, options), Path());
  Scene scene = document.scene();
  const Origin origin = origin_of(scene);
  document.path_ = origin.file;
  document.stamp_ = {{}, origin.sha256};
  scene = without_origin(std::move(scene));
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
  stamp_.time = time;  // new time, same content
  return false;
}

std::vector<Path> Document::withheld() const {
  return {pictures_.withheld().begin(), pictures_.withheld().end()};
}

std::string Document::name() const {
  if (!path_.empty()) return path_.filename().string();
  const Path source = first_picture();
  return source.empty() ? "Untitled" : source.stem().string();
}

std::string Document::title() const {
  return name() + (path_.empty() && !first_picture().empty() ? " (not saved)" : "");
}

Path Document::first_picture() const {
  for (const SharedLayer& layer : scene().layers)
    if (layer->image) return layer->image->file;
  return {};
}

std::vector<size_t> Document::layers_without_picture() const {
  std::vector<size_t> layers;
  for (size_t i = 0; i < scene().layers.size(); ++i)
    if (const Layer& layer = *scene().layers[i]; layer.image && !pictures_.of(layer))
      layers.push_back(i);
  return layers;
}

Sources Document::sources() const {
  return sources_of(scene(), path_);
}

bool Document::commit(const std::string& label, Scene scene, std::optional<double> at) {
  return history_.commit(label, std::move(scene), at);
}

void Document::describe_films() {
  std::vector<Layer> layers = layers_of(scene());
  bool changes = false;
  for (Layer& layer : layers) {
    const Picture* picture = layer.image ? pictures_.find(*layer.image) : nullptr;
    if (!picture || !picture->footage) continue;
    ImageReference now = described(*layer.image, *picture);
    changes = changes || now.clip != layer.image->clip;
    layer.image = std::move(now);
  }
  if (!changes) return;
  Scene described = scene();
  described.layers = shared(std::move(layers));
  history_.replace(std::move(described));
}

std::vector<Layer> Document::layers_of_file(const std::string& file) const {
  std::vector<Layer> all;
  std::set<const Layer*> seen;
  std::set<std::pair<std::string, PixelPosition>> kinds;
  for (const History::Entry& entry : history_.entries())
    for (const SharedLayer& layer : entry.scene.layers) {
      if (!seen.insert(&*layer).second || !layer->image || layer->image->file != file ||
          layer->image->entry.empty())
        continue;
      if (!kinds.insert({layer->image->entry, layer->image->corner}).second) continue;
      Layer known;  // without its deformation
      known.name = layer->name;
      known.image = layer->image;
      all.push_back(std::move(known));
    }
  return all;
}

void Document::update_layers(const LayerUpdate& update) {
  // Steps of the history share most of their layers.
  std::map<std::pair<const Layer*, PixelPosition>, SharedLayer> known;
  const auto updated_layer = [&](const SharedLayer& before, const PixelPosition& carried) {
    if (!before->image || before->image->file != update.file) return before;
    const std::pair key(&*before, carried);
    if (const auto found = known.find(key); found != known.end()) return found->second;
    Layer layer = *before;
    update.apply(layer, carried);
    if (const Picture* picture = pictures_.find(*layer.image); picture && picture->mark)
      layer.image = described(*layer.image, *picture);
    return known.emplace(key, SharedLayer(std::move(layer))).first->second;
  };
  const auto updated = [&](const Scene& scene) {
    std::vector<const Layer*> all;
    for (const SharedLayer& layer : scene.layers) all.push_back(&*layer);
    Scene result = scene;
    for (SharedLayer& layer : result.layers)
      layer = updated_layer(layer, update.carried(all, *layer));
    return result;
  };
  history_.revise_all(updated);
  saved_ = updated(saved_);
}

namespace {

/// The scene with references updated to the pictures in memory. Copies pasted pictures to files
/// next to the scene's file, and refers to the copies.
Scene with_current_pictures(Scene scene, Pictures& pictures, const Path& target) {
  std::vector<Layer> layers = layers_of(scene);
  for (Layer& layer : layers) {
    if (!layer.image) continue;
    ImageReference& image = *layer.image;
    if (const Picture* now = pictures.find(image)) image = described(image, *now);
    const Path file = image.file;
    const Picture* picture = pictures.find(image);
    if (file.parent_path() != pasted_folder() || !picture) continue;
    const Path copy =
        target.parent_path() / (target.stem().string() + "-" + file.stem().string() + ".png");
    // A pasted picture is named after its content. If the file exists, it is already the copy.
    if (!path_exists(copy)) write_file(copy, encode_png(*picture->image));
    Picture copied = *picture;
    std::error_code ignored;
    copied.changed = fs::last_write_time(copy, ignored);
    image.file = copy.string();
    pictures.put(image, std::move(copied));
  }
  scene.layers = shared(std::move(layers));
  return scene;
}

}  // namespace

void Document::save(const Path& path) {
  const Path target = absolute_path(path);
  check_not_read_only(target);
  Scene present = with_current_pictures(scene(), pictures_, target);
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
    fs::permissions(folder, fs::perms::owner_all, ignored);  // accessible only to this user
  }
  try {
    if (!lock_) lock_ = std::make_shared<FileLock>(lock_path(path));
    write_file(path, json_of(with_origin(portable(scene(), Path()), {path_, stamp_.sha256})),
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

}  // namespace holomorph
