// The tables of pictures, films and exports, put together by the extensions of files.
#include "cli/formats.h"

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "film/film_writer.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/image.h"
#include "scene/formats/layered.h"

namespace holomorph {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string text_of(FileContent content) {
  switch (content) {
    case FileContent::scene:
      return "a scene";
    case FileContent::picture:
      return "a picture";
    case FileContent::path:
      return "a cage or an outline";
    case FileContent::surface:
      return "a surface, a cage or an outline";
    case FileContent::points:
      return "points";
  }
  return "";
}

std::string options_of(const ExportFormat& format) {
  std::vector<std::string> options;
  if (format.scale) options.push_back("--scale");
  if (format.crop) options.insert(options.end(), {"--crop", "--rect"});
  if (format.time) options.push_back("--time");
  if (format.frames) options.push_back("--frames");
  if (format.meshes) options.push_back("--vertices");
  if (format.all_layers) options.insert(options.end(), {"--rate", "--keys"});
  if (format.st_map) options.insert(options.end(), {"--overscan", "--half"});
  return joined(options, " ");
}

/// What the program writes to files with this extension.
std::vector<std::string> written_to(const std::string& extension) {
  std::vector<std::string> writes;
  const auto add = [&](const std::string& text) {
    if (std::ranges::find(writes, text) == writes.end()) writes.push_back(text);
  };
  for (const PictureFormat& format : picture_formats())
    if (format.extension == extension) add("the picture");
  for (const ExportFormat& format : export_formats())
    if (std::ranges::count(format.extensions, extension) > 0) add(format.writes);
  return writes;
}

struct Row {
  std::string files, opens, writes;
};

std::vector<Row> rows() {
  std::vector<Row> rows;
  std::vector<std::string> known;
  for (const FileKind& kind : file_kinds()) {
    std::vector<std::string> writes = written_to(kind.extensions[0]);
    if (kind.content == FileContent::scene || kind.content == FileContent::points)
      writes.insert(writes.begin(), text_of(kind.content));
    const bool layered = may_have_layers("a" + kind.extensions[0]);
    rows.push_back({joined(kind.extensions, " "),
                    layered ? "a picture with its layers" : text_of(kind.content),
                    joined(writes, "; ")});
    known.insert(known.end(), kind.extensions.begin(), kind.extensions.end());
  }
  for (const ExportFormat& format : export_formats())
    for (const std::string& extension : format.extensions) {
      if (std::ranges::count(known, extension) > 0) continue;
      rows.push_back({extension, "", joined(written_to(extension), "; ")});
      known.push_back(extension);
    }
  return rows;
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> all = [] {
    std::vector<ExportFormat> formats{
        {.id = "obj",
         .extensions = {".obj"},
         .writes = "the bent mesh",
         .time = true,
         .frames = true,
         .meshes = true},
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
         .extensions = {".exr", ".npy"},
         .writes = "an ST-map",
         .scale = true,
         .time = true,
         .frames = true,
         .st_map = true},
        {.id = "unwarp-map",
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
    const auto add_meshes = [&](const char* id, const char* extension, const char* writes,
                                bool all_layers) {
      formats.push_back({.id = id,
                         .extensions = {extension},
                         .writes = writes,
                         .time = true,
                         .frames = true,
                         .meshes = true,
                         .all_layers = all_layers});
    };
    add_meshes("glb", ".glb", "the moving layers as glTF", true);
    add_meshes("godot", ".tscn", "the moving layers as a scene of Godot 3", true);
    add_meshes("spine", ".json", "the moving layers as a Spine skeleton", true);
    add_meshes("mdd", ".mdd", "the moving vertices of the mesh", false);
    add_meshes("pc2", ".pc2", "the moving vertices of the mesh", false);
    for (const LayeredFormat& layered : layered_formats())
      formats.push_back({.id = layered.extension.substr(1),
                         .extensions = {layered.extension},
                         .writes = "the posed layers",
                         .scale = true,
                         .crop = true,
                         .time = true});
    for (const FilmFormat& film : film_formats())
      if (film.extension != ".png")
        formats.push_back({.id = film.extension.substr(1),
                           .extensions = {film.extension},
                           .writes = film.needs_ffmpeg ? "a film (needs ffmpeg)" : "a film",
                           .scale = true,
                           .crop = true,
                           .frames = true,
                           .film = true});
    return formats;
  }();
  return all;
}

std::string export_format_names() {
  std::vector<std::string> names;
  for (const ExportFormat& format : export_formats()) names.push_back(format.id);
  return joined(names, ", ");
}

const ExportFormat& export_format_named(const std::string& id) {
  const auto found = std::ranges::find(export_formats(), id, &ExportFormat::id);
  if (found != export_formats().end()) return *found;
  throw Error(ErrorKind::bad_input,
              "unknown format '" + id + "'; choose one of: " + export_format_names());
}

void run(const FormatsCommand& command) {
  if (command.markdown) {
    std::puts("| files | opened as | what is written |\n|---|---|---|");
    for (const Row& row : rows())
      std::printf("| %s | %s | %s |\n", row.files.c_str(), row.opens.c_str(), row.writes.c_str());
    return;
  }
  std::printf("%-18s %-32s %s\n", "files", "opened as", "what is written");
  for (const Row& row : rows())
    std::printf("%-18s %-32s %s\n", row.files.c_str(), row.opens.c_str(), row.writes.c_str());
  std::printf("\n%-18s %-32s %s\n", "export --format", "files", "options");
  for (const ExportFormat& format : export_formats())
    std::printf("%-18s %-32s %s\n", format.id.c_str(), joined(format.extensions, " ").c_str(),
                options_of(format).c_str());
}

}  // namespace holomorph
