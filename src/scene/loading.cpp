// Paths in a scene file are relative to the file's folder. In memory, all paths are absolute.
#include "scene/loading.h"

#include <set>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/clips.h"
#include "scene/flattened_surface.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/layered.h"
#include "scene/formats/numbered_frames.h"
#include "scene/formats/scene_json.h"
#include "scene/preferences.h"
#include "scene/prepared_map.h"
#include "scene/recovery.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace fs = std::filesystem;
namespace {

/// The absolute path of a file named in a scene file.
Path resolved_path(const Path& scene, const Path& file) {
  return absolute_path(file.is_absolute() ? file : scene.parent_path() / file);
}

/// The inverse of resolved_path(): the path relative to an absolute folder. Returns the path
/// unchanged if the folder is empty.
std::string relative_to(const Path& folder, const Path& file) {
  const Path relative = folder.empty() ? Path() : file.lexically_relative(folder);
  return relative.empty() ? file.string() : relative.generic_string();
}

/// Calls `use` for every file that a layer of the scene refers to.
template <class Use>
void for_each_file(std::vector<Layer>& layers, Use use) {
  for (Layer& layer : layers) {
    if (layer.image) use(layer.image->file);
    if (layer.deformation.surface) use(layer.deformation.surface->file);
  }
}

/// If a file with the same name and content lies next to the scene, redirects the reference to it.
void look_next_to_scene(const Path& scene, ImageReference& reference, const Reach& reach,
                        PictureFiles& files) {
  const Path name = Path(reference.file).filename();
  if (name.empty()) return;
  const Path moved = resolved_path(scene, name);
  if (!reach.covers(moved, scene.parent_path())) return;
  try {
    if (files.sha256(moved.string()) == reference.sha256) reference.file = moved.string();
  } catch (const Error&) {
    // There is no readable copy next to the scene.
  }
}

/// Older scenes of OpenRaster layers have no marks, and the opacity of such a layer was part of its
/// pixels. Now it is the layer's.
void keep_opacity(Layer& layer, PictureFiles& files) {
  const ImageReference& image = *layer.image;
  if (image.mark || image.entry.empty()) return;
  if (lower_case(Path(image.file).extension().string()) != ".ora") return;
  for (const FileLayer& in_file : files.layers(image.file).layers)
    if (in_file.entry == image.entry) layer.opacity *= in_file.opacity;
}

/// Reads the picture of a layer. Returns a warning, or "" if there is none. A missing picture
/// causes a warning if pictures may be missing, otherwise an Error.
std::string load_picture(Layer& layer, Pictures& pictures, PictureFiles& files, const Path& scene,
                         const std::string& pointer, const LoadOptions& options) {
  if (!layer.image) return "";
  ImageReference& reference = *layer.image;
  if (pictures.withheld().contains(reference.file))
    return "/image/file: " + reference.file + " is not in the scene's folder.";
  if (!path_exists(reference.file)) look_next_to_scene(scene, reference, options.reach, files);
  try {
    if (!pictures.find(reference)) pictures.put(reference, files.picture(reference));
  } catch (const Error& error) {
    const std::string what = pointer + "/image/file: " + error.what();
    if (!options.pictures_may_be_missing) throw Error(error.kind(), what);
    return what;
  }
  keep_opacity(layer, files);
  const Picture& picture = *pictures.find(reference);
  const bool other = !reference.sha256.empty() && reference.sha256 != picture.sha256;
  reference = described(std::move(reference), picture);
  return other ? "The picture " + Path(reference.file).filename().string() +
                     " has changed since the scene was saved."
               : "";
}

}  // namespace

std::string LoadedScene::message(size_t lines) const {
  std::string all = warning;
  const auto add = [&](const ImportReport& each) {
    const std::string text = each.text(lines);
    all += (all.empty() || text.empty() ? "" : "\n") + text;
  };
  add(report);
  for (const LayerUpdate& update : updates) add(update.report);
  return all;
}

std::string read_scene_file(const Path& path) {
  std::error_code missing;
  const auto size = fs::file_size(path, missing);
  if (!missing)
    check_budget(&Budget::scene, static_cast<double>(size), path.string() + ": its size is");
  return read_file(path);
}

LoadedScene load_scene(const Path& path, const LoadOptions& options) {
  return scene_of_text(read_scene_file(path), path, options);
}

namespace {

/// Withholds the files that are out of a scene's reach before any of them is accessed. Throws Error
/// instead if pictures must not be missing. If a copy of a picture lies next to the scene, the copy
/// is used.
void withhold_unreachable(std::vector<Layer>& layers, const Path& scene, const LoadOptions& options,
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
      look_next_to_scene(scene, *image, options.reach, files);
      if (!options.reach.covers(image->file, folder)) withhold(image->file, "/image/file");
    }
    if (const auto& surface = layers[i].deformation.surface;
        surface && !options.reach.covers(surface->file, folder))
      withhold(surface->file, "/surface/file");
  }
}

/// What to say about the first layer of an update that is unclear.
std::string unclear_text(const LayerUpdate& update) {
  return update.report.file + ": the file has changed, and it is not clear which layer '" +
         update.unclear[0].name + "' is now";
}
std::string question_of(const LayerUpdate& update) {
  const UnclearLayer& unclear = update.unclear[0];
  std::string text = update.report.file + ": the file has changed, and the layer '" + unclear.name +
                     "' may now be ";
  constexpr size_t kMostNamed = 5;
  const size_t named = std::min(unclear.candidates.size(), kMostNamed);
  for (size_t i = 0; i < named; ++i) {
    const bool is_last = i + 1 == unclear.candidates.size();
    text += (i == 0 ? "'" : is_last ? " or '" : ", '") + unclear.candidates[i].name + "'";
  }
  if (named < unclear.candidates.size()) text += " or another layer";
  return text + "; use holomorph update with --match '" + unclear.name +
         "=NAME', or with no name after = if it is none of them";
}

/// The choices about the layers of one file.
LayerChoices choices_for(const std::string& file, std::span<const Layer> layers,
                         const LayerChoices& choices) {
  LayerChoices result;
  std::ranges::copy_if(choices, std::back_inserter(result), [&](const auto& choice) {
    return std::ranges::any_of(layers, [&](const Layer& layer) {
      return layer.image && layer.image->file == file &&
             (layer.image->entry == choice.first || name_in_file(layer) == choice.first);
    });
  });
  return result;
}

void check_choices(std::span<const Layer> layers, const std::set<std::string>& files,
                   const LayerChoices& choices) {
  for (const auto& choice : choices)
    if (std::ranges::none_of(files, [&](const std::string& file) {
          return !choices_for(file, layers, {choice}).empty();
        }))
      throw Error(ErrorKind::bad_input,
                  "the scene has no layer of a file with the name '" + choice.first + "'");
}

/// Finds the layers of the files that have changed. Returns the files in which this fails, whose
/// layers must not be read.
std::set<std::string> update_layers(std::vector<Layer>& layers, const Path& scene,
                                    const LoadOptions& options, PictureFiles& files,
                                    LoadedScene& loaded) {
  std::set<std::string> failed;
  std::set<std::string> names;
  for (const Layer& layer : layers)
    if (layer.image && !layer.image->entry.empty()) names.insert(layer.image->file);
  check_choices(layers, names, options.choices);
  for (const std::string& name : names) {
    if (loaded.pictures.withheld().contains(name) || !path_exists(name)) continue;
    try {
      const LayerChoices choices = choices_for(name, layers, options.choices);
      if (choices.empty() && !options.looks_for_layers && !needs_layer_update(layers, name, files))
        continue;
      LayerUpdate update = layer_update(layers, name, files, choices);
      if (!update.unclear.empty() && !options.pictures_may_be_missing)
        throw Error(ErrorKind::bad_input, question_of(update));
      std::vector<const Layer*> all;
      for (const Layer& layer : layers) all.push_back(&layer);
      std::vector<PixelPosition> carried;
      for (const Layer& layer : layers) carried.push_back(update.carried(all, layer));
      for (size_t i = 0; i < layers.size(); ++i) update.apply(layers[i], carried[i]);
      if (!update.unclear.empty() && loaded.warning.empty()) loaded.warning = unclear_text(update);
      loaded.updates.push_back(std::move(update));
    } catch (const Error& error) {
      if (!options.pictures_may_be_missing) throw about(scene, error);
      if (loaded.warning.empty()) loaded.warning = error.what();
      failed.insert(name);
    }
  }
  return failed;
}

}  // namespace

LoadedScene scene_of_text(const std::string& text, const Path& path, const LoadOptions& options) {
  LoadedScene loaded;
  loaded.sha256 = sha256_hex(text);
  loaded.scene = scene_from_json(text, path.string());
  PictureFiles files(options.open_pixels);
  std::vector<Layer> layers = layers_of(loaded.scene);
  try {
    check_affordable(layers);
  } catch (const Error& error) {
    throw about(path, error);
  }
  for_each_file(layers, [&](std::string& file) { file = resolved_path(path, file).string(); });
  withhold_unreachable(layers, path, options, files, loaded.pictures);
  const std::set<std::string> failed = update_layers(layers, path, options, files, loaded);
  for (size_t i = 0; i < layers.size(); ++i) {
    const auto& image = layers[i].image;
    if (image && (is_unclear(*image) || (!image->entry.empty() && failed.contains(image->file))))
      continue;
    const std::string pointer =
        path.string() + ": " + (layers.size() > 1 ? "/layers/" + std::to_string(i) : "");
    const std::string warning =
        load_picture(layers[i], loaded.pictures, files, path, pointer, options);
    if (loaded.warning.empty()) loaded.warning = warning;
  }
  loaded.scene.layers = shared(std::move(layers));
  try {
    loaded.pictures.show_time(loaded.scene, 0);
  } catch (const Error& error) {
    if (!options.pictures_may_be_missing) throw;
    if (loaded.warning.empty()) loaded.warning = error.what();
  }
  if (!options.keeps_origin) loaded.scene = without_origin(std::move(loaded.scene));
  return loaded;
}

Sources sources_of(const Scene& scene, const Path& scene_path) {
  Sources sources{scene_path, {}, {}};
  for (const SharedLayer& layer : scene.layers) {
    if (layer->image) sources.images.emplace_back(layer->image->file);
    if (clip_of(*layer) && !is_named_as(layer->image->file, FileContent::film))
      for (Path& file : numbered_pictures(layer->image->file))
        sources.images.push_back(std::move(file));
    if (const auto& surface = layer->deformation.surface)
      sources.surfaces.emplace_back(surface->file);
  }
  return sources;
}

Sources sources_in(const Path& path) {
  Scene scene = scene_from_json(read_scene_file(path), path.string());
  std::vector<Layer> layers = layers_of(scene);
  for_each_file(layers, [&](std::string& file) { file = resolved_path(path, file).string(); });
  scene.layers = shared(std::move(layers));
  return sources_of(scene, path);
}

void check_not_a_source(const Path& out, const Sources& sources) {
  if (!path_exists(out)) return;
  const auto refuse_if = [&](const Path& source, const char* what) {
    std::error_code ignored;
    if (!source.empty() && fs::equivalent(out, source, ignored))
      throw Error(ErrorKind::bad_input,
                  out.string() + ": this is the " + what + "; choose another name");
  };
  refuse_if(sources.scene, "scene itself");
  for (const Path& image : sources.images) refuse_if(image, "picture that the scene deforms");
  for (const Path& surface : sources.surfaces) refuse_if(surface, "surface that the scene uses");
}

void check_may_write(const Path& out, const Sources& sources) {
  check_not_a_source(out, sources);
  check_not_read_only(out);
}

namespace {

/// A layer with the picture from a file.
Layer layer_of_picture(const Path& file, PictureFiles& files, Pictures& pictures) {
  const ImageReference reference = reference_in(file);
  Picture picture = files.picture(reference);
  Layer layer;
  layer.image = described(reference, picture);
  pictures.put(*layer.image, std::move(picture));
  return layer;
}

/// The layers of a picture's file, if it has some. If there are too many, the lowest are left out.
FileLayers layers_in(const Path& path) {
  FileLayers all;
  if (may_have_layers(path)) all = layers_of_file(read_file(path), path.string());
  all.report.file = path.filename().string();
  if (all.layers.size() <= kMaxLayers) return all;
  const size_t over = all.layers.size() - kMaxLayers;
  all.layers.erase(all.layers.begin(), all.layers.begin() + static_cast<std::ptrdiff_t>(over));
  all.report.add("", "left out: the lowest " + std::to_string(over) +
                         " of its layers, because a scene has at most " +
                         std::to_string(kMaxLayers));
  for (FileLayer& layer : all.layers) {
    if (!layer.clipped) break;
    layer.clipped = false;
    all.report.add(layer.name, "left out: its clipping");
  }
  return all;
}

/// What is left out of a picture without layers that can be decoded.
ImportReport report_of_picture(const Path& path) {
  if (is_named_as(path, FileContent::film)) return {};
  return report_of_image(read_file(path), path.string());
}

}  // namespace

ImportReport import_report(const Path& image) {
  FileLayers in_file = layers_in(image);
  if (in_file.layers.empty()) in_file.report.add(report_of_picture(image));
  return in_file.report;
}

LoadedScene scene_of_image(const Path& path, double open_pixels) {
  LoadedScene loaded;
  PictureFiles files(open_pixels);
  FileLayers in_file = layers_in(path);
  loaded.report = std::move(in_file.report);
  if (in_file.layers.empty()) {
    loaded.scene = scene_of(layer_of_picture(path, files, loaded.pictures));
    loaded.report.add(report_of_picture(path));
    if (const auto footage = loaded.pictures.footage(loaded.scene.layer());
        footage && footage->info().is_hdr)
      loaded.report.add("", "its HDR colors are toned down to those of ordinary screens");
    if (const Clip* clip = clip_of(loaded.scene.layer()))
      loaded.scene.animation.frames_per_second = clip->frames_per_second;
    // Parts of a photograph that move away leave gaps, which the original fills.
    if (loaded.image() && is_opaque(*loaded.image()))
      loaded.scene.background.fill = Background::Fill::original;
    return loaded;
  }
  std::vector<Layer> layers;
  for (const FileLayer& each : in_file.layers) {
    layers.push_back(layer_in_file(path, each, {}, files, loaded.pictures));
    layers.back().id = static_cast<int>(layers.size());
  }
  size_t edited = layers.size() - 1;
  while (edited > 0 && !layers[edited].visible) --edited;
  loaded.scene.layers = shared(std::move(layers));
  loaded.scene.edited = edited;
  return loaded;
}

LoadedScene scene_of_pasted(const std::string& png) {
  decode_image(png, "the clipboard");
  if (pasted_folder().empty())
    throw Error(ErrorKind::failed,
                "Pasted pictures cannot be stored because this user has no home folder. Save the "
                "picture as a file and open that file");
  std::error_code ignored;
  fs::create_directories(pasted_folder(), ignored);
  const Path file = pasted_folder() / (sha256_hex(png).substr(0, 16) + ".png");
  write_file(file, png);
  LoadedScene pasted = scene_of_image(file);
  Layer layer = pasted.scene.layer();
  layer.name = "Pasted";
  pasted.scene = scene_of(std::move(layer));
  return pasted;
}

LoadedScene scene_of_surface(const Path& obj, const Reach& reach) {
  const SurfaceFile file = surface_of_obj(read_file(obj), obj.string());
  const auto in_reach = [&](const Path& named) {
    if (reach.covers(named, obj.parent_path())) return named;
    throw Error(ErrorKind::bad_input, obj.string() + ": it refers to " + named.string() +
                                          ", which is not in its folder; move it there");
  };
  const auto texture = [&]() -> std::string {
    if (file.materials.empty()) return "";
    return texture_of_materials(read_file(in_reach(resolved_path(obj, file.materials))));
  }();
  if (texture.empty())
    throw Error(ErrorKind::bad_input, obj.string() +
                                          ": this surface has no texture picture. Open a picture, "
                                          "add a cage, and then drop the surface onto the picture");
  LoadedScene loaded =
      scene_of_image(in_reach(resolved_path(resolved_path(obj, file.materials), texture)));
  try {
    Deformation deformation = with_cage({}, texture_boundary(file, loaded.image()->page()));
    check_rest_cage(deformation.rest);
    loaded.scene = with_deformation(std::move(loaded.scene), std::move(deformation));
  } catch (const Error& error) {
    throw about(obj, error);
  }
  return loaded;
}

Scene portable(Scene scene, const Path& folder) {
  std::vector<Layer> layers = layers_of(scene);
  for_each_file(layers, [&](std::string& file) { file = relative_to(folder, file); });
  scene.layers = shared(std::move(layers));
  return scene;
}

}  // namespace holomorph
