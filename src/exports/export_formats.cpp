// Formats of layers and films have tables of their own, which are included.
#include "exports/export_formats.h"

#include <algorithm>

#include "core/error.h"
#include "film/film_writer.h"
#include "scene/formats/layered.h"

namespace holomorph {

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> all = [] {
    std::vector<ExportFormat> formats{
        {.id = "obj",
         .label = "Mesh (OBJ)",
         .extensions = {".obj"},
         .writes = "the bent mesh",
         .time = true,
         .frames = true,
         .meshes = true,
         .sequence = true},
        {.id = "svg", .extensions = {".svg"}, .writes = "the cage", .time = true},
        {.id = "npy", .extensions = {".npy"}, .writes = "the vertices of the mesh", .time = true},
        {.id = "png",
         .extensions = {".png"},
         .writes = "the picture",
         .scale = true,
         .crop = true,
         .time = true,
         .frames = true},
        {.id = "stmap",
         .label = "ST-map (OpenEXR)",
         .extensions = {".exr", ".npy"},
         .writes = "an ST-map",
         .scale = true,
         .time = true,
         .frames = true,
         .st_map = true},
        {.id = "unwarp-map",
         .label = "Unwarping ST-map (OpenEXR)",
         .extensions = {".exr", ".npy"},
         .writes = "an ST-map that straightens",
         .scale = true,
         .time = true,
         .frames = true,
         .st_map = true},
        {.id = "unwarp",
         .extensions = {".png"},
         .writes = "the straightened picture",
         .scale = true,
         .time = true},
        {.id = "textured",
         .extensions = {".obj"},
         .writes = "the surface with the picture as its texture",
         .scale = true}};
    for (ExportFormat meshes : {ExportFormat{.id = "glb",
                               .label = "Moving meshes (glTF)",
                               .extensions = {".glb"},
                               .writes = "the moving layers as glTF",
                               .all_layers = true},
                                {.id = "godot",
                                .label = "Godot 4 scene",
                                .extensions = {".tscn"},
                                .writes = "the moving layers as a scene of Godot 4",
                                .all_layers = true,
                                .textures = true},
                                {.id = "godot3",
                                .label = "Godot 3 scene",
                                .extensions = {".tscn"},
                                .writes = "the moving layers as a scene of Godot 3",
                                .all_layers = true,
                                .textures = true},
                                {.id = "spine",
                                .label = "Spine skeleton",
                                .extensions = {".json"},
                                .writes = "the moving layers as a Spine skeleton",
                                .all_layers = true,
                                .textures = true},
                                {.id = "mdd",
                                .label = "Vertex cache (MDD)",
                                .extensions = {".mdd"},
                                .writes = "the moving vertices of the mesh"},
                                {.id = "pc2",
                                .label = "Vertex cache (PC2)",
                                .extensions = {".pc2"},
                                .writes = "the moving vertices of the mesh"}}) {
      meshes.time = meshes.frames = meshes.meshes = true;
      formats.push_back(std::move(meshes));
    }
    for (const LayeredFormat& layered : layered_formats())
      formats.push_back({.id = layered.id,
                         .label = layered.label,
                         .extensions = {layered.extension},
                         .writes = layered.keeps_drawings ? "the posed layers, drawings as drawings"
                                                          : "the posed layers",
                         .scale = true,
                         .crop = true,
                         .time = true});
    for (const FilmFormat& film : film_formats())
      if (film.extension != ".png")
        formats.push_back({.id = film.extension.substr(1),
                           .label = film.label,
                           .extensions = {film.extension},
                           .writes = film.needs_ffmpeg ? "a film (needs ffmpeg)" : "a film",
                           .scale = true,
                           .crop = true,
                           .frames = true,
                           .film = true,
                           .sound = film.can_have_sound});
    return formats;
  }();
  return all;
}

std::string export_format_names() {
  std::string names;
  for (const ExportFormat& format : export_formats())
    names += (names.empty() ? "" : ", ") + format.id;
  return names;
}

const ExportFormat& export_format_named(const std::string& id) {
  const auto found = std::ranges::find(export_formats(), id, &ExportFormat::id);
  if (found != export_formats().end()) return *found;
  throw Error(ErrorKind::bad_input,
              "unknown format '" + id + "'; choose one of: " + export_format_names());
}

}  // namespace holomorph
