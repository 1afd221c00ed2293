// Some formats consist of several files, which lie next to each other.
#include "cli/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/formats.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "core/error.h"
#include "film/film_writer.h"
#include "raster/moving_meshes.h"
#include "scene/budget.h"
#include "scene/formats/surface_file.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "system/text.h"

namespace holomorph {
namespace {

constexpr double kGoodError = 0.5;  ///< pixels

/// The times of all keyframes between two times, and these two.
std::vector<double> key_times(const Scene& scene, double from, double to) {
  std::vector<double> times{from, to};
  for (const SharedLayer& layer : scene.layers)
    for (const Keyframe& key : layer->deformation.keyframes)
      if (from < key.time && key.time < to) times.push_back(key.time);
  return times;
}

MovingMeshOptions options_of(const Scene& scene, const ExportCommand& command) {
  const ExportFormat& format = export_format_named(command.format);
  MovingMeshOptions options;
  options.vertices = command.vertices;
  options.edited_only = !format.all_layers;
  if (command.moments.time) options.times = {*command.moments.time};
  if (command.moments.time || (!command.moments.frames && !plays(scene))) {
    if (command.rate || command.keys)
      throw Error(ErrorKind::bad_input,
                  "--rate and --keys are for a motion; the export has a single moment");
    return options;
  }
  const double rate = scene.animation.frames_per_second;
  const FrameRange range = frames_named(command.moments.frames.value_or("all"), scene);
  std::vector<double> frames;
  for (int i = range.first; i <= range.last; ++i) frames.push_back(i / rate);
  if (command.keys) {
    options.times = key_times(scene, frames.front(), frames.back());
  } else if (command.rate) {
    const double length = frames.back() - frames.front();
    check_budget(&Budget::frames, length * *command.rate, "the export has");
    for (int k = 0; k < length * *command.rate - 1e-6; ++k)
      options.times.push_back(frames.front() + k / *command.rate);
    options.times.push_back(frames.back());
  } else {
    options.times = frames;
  }
  std::ranges::sort(options.times);
  options.times.erase(std::unique(options.times.begin(), options.times.end()), options.times.end());
  check_budget(&Budget::frames, static_cast<double>(options.times.size()), "the export has");
  if (!format.all_layers) return options;
  options.checked = frames;
  for (size_t i = 0; i + 1 < options.times.size(); ++i)
    options.checked.push_back(0.5 * (options.times[i] + options.times[i + 1]));
  return options;
}

/// What the export's error is, and how to lower it.
std::string error_text(const MovingMeshes& moving) {
  std::string text;
  if (moving.frame_error > 0)
    text += csv_line(", at most %.2g px off at the frames", moving.frame_error);
  if (moving.times.size() < 2 || moving.error <= moving.frame_error) return text;
  text += csv_line(", at most %.2g px off between frames", moving.error);
  if (moving.error > kGoodError && moving.frame_error < kGoodError) {
    // Between frames, the error of linear interpolation falls with the square of the rate.
    double longest = 0;
    for (size_t i = 0; i + 1 < moving.times.size(); ++i)
      longest = std::max(longest, moving.times[i + 1] - moving.times[i]);
    const double finer =
        std::sqrt((moving.error - moving.frame_error) / (kGoodError - moving.frame_error));
    text += csv_line("; with --rate %.0f, less than %.2g px", std::ceil(1.1 * finer / longest),
                     kGoodError);
  }
  return text;
}

/// The files of an export and what they contain, the main one first.
using OutFiles = std::vector<std::pair<Path, std::string>>;

/// The textures of all meshes next to the main file, by file name; "" for a mesh without one.
std::vector<std::string> add_textures(const MovingMeshes& moving, const Path& out,
                                      OutFiles& files) {
  std::vector<std::string> names;
  const std::vector<std::string> meshes = unique_names(moving);
  for (size_t i = 0; i < moving.meshes.size(); ++i) {
    names.emplace_back();
    if (moving.meshes[i].texture.width == 0) continue;
    names.back() = out.stem().string() + "-" + meshes[i] + ".png";
    files.emplace_back(out.parent_path() / names.back(), encode_png(moving.meshes[i].texture));
  }
  return names;
}

/// A sequence of OBJ files that share a material.
OutFiles obj_files(const MovingMeshes& moving, const Path& out, int first) {
  const MovingMesh& mesh = moving.meshes[0];
  const auto with = [&](const char* extension) { return Path(out).replace_extension(extension); };
  Points coordinates;
  for (const Complex& z : mesh.rest) coordinates.push_back(texture_coordinate(mesh, z));
  OutFiles files;
  for (size_t k = 0; k < mesh.frames.size(); ++k) {
    Surface surface;
    for (const Complex& z : mesh.frames[k]) surface.vertices.push_back({z.real(), z.imag(), 0});
    surface.triangles = mesh.triangles;
    files.emplace_back(numbered(out, first + static_cast<int>(k)),
                       obj_of(surface, coordinates, with(".mtl").filename().string()));
  }
  if (mesh.texture.width == 0) {
    files.emplace_back(with(".mtl"), material_of(""));
    return files;
  }
  const Path texture = out.parent_path() / (out.stem().string() + "-texture.png");
  files.emplace_back(with(".mtl"), material_of(texture.filename().string()));
  files.emplace_back(texture, encode_png(mesh.texture));
  return files;
}

OutFiles files_of(const MovingMeshes& moving, const ExportCommand& command, const Scene& scene) {
  const Path& out = command.out;
  const std::string& format = command.format;
  if (format == "obj")
    return obj_files(moving, out, frames_named(*command.moments.frames, scene).first);
  if (format == "glb") return {{out, glb_of(moving)}};
  if (format == "mdd") return {{out, mdd_of(moving.meshes[0], moving.times)}};
  if (format == "pc2") return {{out, pc2_of(moving.meshes[0], moving.times)}};
  OutFiles files{{out, ""}};
  const std::vector<std::string> textures = add_textures(moving, out, files);
  files[0].second = format == "godot" ? godot_of(moving, textures) : spine_of(moving, textures);
  return files;
}

/// What the format cannot express.
void print_losses(const Scene& scene) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (!is_shown(scene, i)) continue;
    const auto say = [&](const char* lost) {
      std::fprintf(stderr, "holomorph: %s: its %s is not kept\n",
                   printable(title_of_layer(scene, i)).c_str(), lost);
    };
    if (clip_base(scene, i)) say("clipping");
    if (layer.blending != Blending::normal) say("blending mode");
  }
}

}  // namespace

void export_meshes(const LoadedScene& loaded, const ExportCommand& command) {
  const Scene& scene = loaded.scene;
  const bool is_alone =
      command.format == "glb" || command.format == "mdd" || command.format == "pc2";
  if (is_standard(command.out) && !is_alone)
    throw Error(ErrorKind::bad_input,
                command.format + " has several files; give a file name with --out");
  const bool all_layers = export_format_named(command.format).all_layers;
  if (!all_layers) require_cage(scene, command.scene);
  check_out(command.out, command.force, command.scene, loaded);
  const DeferredStop tidy;
  MovingMeshes moving;
  OutFiles files;
  {
    Progress progress("export", "frame");
    moving = moving_meshes_of(scene, loaded.image(), loaded.pictures, options_of(scene, command),
                              [&](size_t done, size_t all) { progress.step(done, all); });
    files = files_of(moving, command, scene);
  }
  for (const auto& [path, bytes] : files) check_out(path, command.force, command.scene, loaded);
  // The main file comes last, so that what it refers to is there.
  for (size_t i = files.size(); i-- > 1;) write_file(files[i].first, files[i].second);
  write_result(files[0].first, files[0].second);
  if (all_layers) print_losses(scene);
  size_t vertices = 0, bytes = 0;
  for (const MovingMesh& mesh : moving.meshes) vertices += mesh.rest.size();
  for (const auto& [path, content] : files) bytes += content.size();
  std::fprintf(stderr, "%s: %zu mesh%s, %zu vertices, %zu frame%s, %zu bytes%s\n",
               shown_output(files[0].first).c_str(), moving.meshes.size(),
               moving.meshes.size() == 1 ? "" : "es", vertices, moving.times.size(),
               moving.times.size() == 1 ? "" : "s", bytes, error_text(moving).c_str());
}

}  // namespace holomorph
