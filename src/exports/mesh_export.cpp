// Some formats consist of several files, which lie next to each other.
#include "exports/mesh_export.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "film/film_writer.h"
#include "raster/fewest_frames.h"
#include "scene/budget.h"
#include "scene/formats/surface_file.h"
#include "scene/keyframes.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

std::string two_digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

Path texture_path(const Path& out, const std::string& mesh) {
  return out.parent_path() / (out.stem().string() + "-" + mesh + ".png");
}

/// The textures of all meshes next to the main file, by file name; "" for a mesh without one.
std::vector<std::string> add_textures(const MovingMeshes& moving, const Path& out,
                                      MeshFiles& files) {
  std::vector<std::string> names;
  const std::vector<std::string> meshes = unique_names(moving);
  for (size_t i = 0; i < moving.meshes.size(); ++i) {
    names.emplace_back();
    if (moving.meshes[i].texture.width == 0) continue;
    const Path path = texture_path(out, meshes[i]);
    names.back() = path.filename().string();
    files.emplace_back(path, encode_png(moving.meshes[i].texture));
  }
  return names;
}

Path material_path(const Path& out) {
  return Path(out).replace_extension(".mtl");
}

/// A sequence of OBJ files that share a material.
MeshFiles obj_files(const MovingMeshes& moving, const Path& out, int first) {
  const MovingMesh& mesh = moving.meshes[0];
  const Path material = material_path(out);
  Points coordinates;
  for (const Complex& z : mesh.rest) coordinates.push_back(texture_coordinate(mesh, z));
  MeshFiles files;
  for (size_t k = 0; k < mesh.frames.size(); ++k) {
    Surface surface;
    for (const Complex& z : mesh.frames[k]) surface.vertices.push_back({z.real(), z.imag(), 0});
    surface.triangles = mesh.triangles;
    files.emplace_back(numbered(out, first + static_cast<int>(k)),
                       obj_of(surface, coordinates, material.filename().string()));
  }
  if (mesh.texture.width == 0) {
    files.emplace_back(material, material_of(""));
    return files;
  }
  const Path texture = texture_path(out, "texture");
  files.emplace_back(material, material_of(texture.filename().string()));
  files.emplace_back(texture, encode_png(mesh.texture));
  return files;
}

/// The times of all keyframes between two times, the ends of poses that are held, and these two.
std::vector<double> key_times(const Scene& scene, double from, double to) {
  std::vector<double> times{from, to};
  const auto add = [&](double time) {
    if (from < time && time < to) times.push_back(time);
  };
  for (const SharedLayer& layer : scene.layers) {
    const std::vector<Keyframe>& keys = layer->deformation.keyframes;
    for (size_t k = 0; k < keys.size(); ++k) {
      add(keys[k].time);
      if (keys[k].ease == Ease::hold && k + 1 < keys.size()) add(keys[k + 1].time - kJump);
    }
  }
  return times;
}

void sort_times(std::vector<double>& times) {
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

/// Where the error between the given times is measured: at the frames and keyframes, and in the
/// middle between all of these, except in jumps.
std::vector<double> checked_times(std::vector<double> times, const std::vector<double>& frames,
                                  const std::vector<double>& keys) {
  std::vector<double> checked = frames;
  checked.insert(checked.end(), keys.begin(), keys.end());
  times.insert(times.end(), checked.begin(), checked.end());
  sort_times(times);
  for (size_t i = 0; i + 1 < times.size(); ++i)
    if (!is_jump(times[i], times[i + 1])) checked.push_back(0.5 * (times[i] + times[i + 1]));
  sort_times(checked);
  return checked;
}

}  // namespace

MovingMeshOptions mesh_options_of(const Scene& scene, const MeshExport& wanted) {
  const ExportFormat& format = export_format_named(wanted.format);
  // The number of vertices falls with the error, that of frames with its square root.
  constexpr double kOfVertices = kVisibleError * 2 / 3, kOfFrames = kVisibleError - kOfVertices;
  MovingMeshOptions options;
  options.vertices = wanted.vertices;
  options.edited_only = !format.all_layers;
  if (format.all_layers && !wanted.vertices && !wanted.full_mesh)
    options.vertex_tolerance = kOfVertices;
  if (wanted.time) options.times = {*wanted.time};
  if (wanted.time || (!wanted.frames && !moves(scene))) {
    if (wanted.rate || wanted.keys)
      throw Error(ErrorKind::bad_input,
                  "--rate and --keys are for a motion; the export has a single moment");
    return options;
  }
  const double rate = scene.animation.frames_per_second;
  const auto [first, last] = wanted.frames.value_or(std::pair(0, last_frame_of(scene)));
  check(first <= last, "mesh_options_of: the frames run backwards");
  check_budget(&Budget::frames, last - first + 1.0, "the export has");
  std::vector<double> frames;
  for (int i = first; i <= last; ++i) frames.push_back(i / rate);
  const std::vector<double> keys = key_times(scene, frames.front(), frames.back());
  if (wanted.keys) {
    options.times = keys;
  } else if (wanted.rate) {
    const double length = frames.back() - frames.front();
    check_budget(&Budget::frames, length * *wanted.rate, "the export has");
    for (int k = 0; k < length * *wanted.rate - 1e-6; ++k)
      options.times.push_back(frames.front() + k / *wanted.rate);
    options.times.push_back(frames.back());
  } else {
    options.times = frames;
    if (format.all_layers) {
      options.times.insert(options.times.end(), keys.begin(), keys.end());
      options.frame_tolerance = kOfFrames;
    }
  }
  sort_times(options.times);
  check_budget(&Budget::frames, static_cast<double>(options.times.size()), "the export has");
  if (format.all_layers) options.checked = checked_times(options.times, frames, keys);
  return options;
}

MeshFiles mesh_files_of(const MovingMeshes& moving, const MeshExport& wanted) {
  const Path& out = wanted.out;
  const std::string& format = wanted.format;
  if (format == "obj") return obj_files(moving, out, wanted.frames ? wanted.frames->first : 0);
  if (format == "glb") return {{out, glb_of(moving)}};
  if (format == "mdd") return {{out, mdd_of(moving.meshes[0], moving.times)}};
  if (format == "pc2") return {{out, pc2_of(moving.meshes[0], moving.times)}};
  MeshFiles files{{out, ""}};
  const std::vector<std::string> textures = add_textures(moving, out, files);
  files[0].second = format == "spine"
                        ? spine_of(moving, textures)
                        : godot_of(moving, textures,
                                   format == "godot3" ? GodotVersion::three : GodotVersion::four);
  return files;
}

std::vector<Path> mesh_file_names(const Scene& scene, const Pictures& pictures,
                                  const MeshExport& wanted) {
  const ExportFormat& format = export_format_named(wanted.format);
  if (format.sequence) {
    const auto [first, last] = wanted.frames.value_or(std::pair(0, last_frame_of(scene)));
    std::vector<Path> names;
    for (int i = first; i <= last; ++i) names.push_back(numbered(wanted.out, i));
    names.push_back(material_path(wanted.out));
    if (pictures.of(scene.layer())) names.push_back(texture_path(wanted.out, "texture"));
    return names;
  }
  std::vector<Path> names{wanted.out};
  if (!format.textures) return names;
  MovingMeshes meshes;
  std::vector<bool> textured;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const bool has_picture = pictures.of(*scene.layers[i]) != nullptr;
    if (!is_shown(scene, i) || !(has_picture || scene.layers[i]->deformation.has_cage())) continue;
    meshes.meshes.emplace_back().name = title_of_layer(scene, i);
    textured.push_back(has_picture);
  }
  const std::vector<std::string> unique = unique_names(meshes);
  for (size_t i = 0; i < unique.size(); ++i)
    if (textured[i]) names.push_back(texture_path(wanted.out, unique[i]));
  return names;
}

std::string mesh_advice(const MovingMeshes& moving, const MeshExport& wanted) {
  constexpr size_t kManyTargets = 256;
  std::string text;
  if (moving.frame_error > kVisibleError)
    text += "; more vertices are closer";
  else if (moving.error > kVisibleError && (wanted.rate || wanted.keys))
    text += "; the fewest frames that are chosen without a rate are closer";
  if (wanted.format == "glb" && moving.times.size() > kManyTargets)
    text +=
        "; some programs do not load more than " + std::to_string(kManyTargets) + " morph targets";
  return text;
}

std::string mesh_counts(const MovingMeshes& moving) {
  size_t vertices = 0;
  for (const MovingMesh& mesh : moving.meshes) vertices += mesh.rest.size();
  const auto counted = [](size_t count, const char* one, const char* more) {
    return std::to_string(count) + " " + (count == 1 ? one : more);
  };
  return counted(moving.meshes.size(), "mesh", "meshes") + ", " +
         counted(vertices, "vertex", "vertices") + ", " +
         counted(moving.times.size(), "frame", "frames");
}

std::string mesh_error_text(const MovingMeshes& moving) {
  std::string text;
  if (moving.frame_error > 0)
    text += ", at most " + two_digits(moving.frame_error) + " px off at the frames";
  if (moving.times.size() > 1 && moving.error > moving.frame_error)
    text += ", at most " + two_digits(moving.error) + " px off between frames";
  return text;
}

std::vector<std::string> mesh_losses_of(const Scene& scene) {
  std::vector<std::string> losses;
  if (scene.background.fill == Background::Fill::color)
    losses.push_back("Background: its color is not kept");
  if (scene.background.fill == Background::Fill::original)
    losses.push_back("Background: the original is not kept");
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (!is_shown(scene, i)) continue;
    if (clip_base(scene, i))
      losses.push_back(title_of_layer(scene, i) + ": its clipping is not kept");
    if (layer.blending != Blending::normal)
      losses.push_back(title_of_layer(scene, i) + ": its blending mode is not kept");
  }
  return losses;
}

}  // namespace holomorph
