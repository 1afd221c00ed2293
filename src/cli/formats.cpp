// The tables of pictures, films and exports, put together by the extensions of files.
#include "cli/formats.h"

#include <algorithm>
#include <cstdio>

#include "exports/export_formats.h"
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
    case FileContent::film:
      return "a film as a picture";
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
  if (format.id == "png") options.push_back("--depth");
  if (format.crop) options.insert(options.end(), {"--crop", "--rect"});
  if (format.time) options.push_back("--time");
  if (format.frames) options.push_back("--frames");
  if (format.sound) options.push_back("--sound");
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
  const std::string picture = "the picture";
  const PictureFormat* format = picture_format_named(extension);
  if (format) add(picture);
  for (const ExportFormat& each : export_formats())
    if (std::ranges::count(each.extensions, extension) > 0) add(each.writes);
  if (format && format->depths.size() > 1)
    std::ranges::replace(writes, picture, picture + " (" + depths_text(*format) + " bits)");
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
    std::vector<std::string> opened;
    for (const FileContent content : kind.contents) opened.push_back(text_of(content));
    if (!kind.needs.empty()) opened[0] += " (needs " + kind.needs + ")";
    if (can_open_as(kind, FileContent::scene) || can_open_as(kind, FileContent::points))
      writes.insert(writes.begin(), opened[0]);
    const bool layered = may_have_layers("a" + kind.extensions[0]);
    rows.push_back({joined(kind.extensions, " "),
                    layered ? "a picture with its layers" : joined(opened, "; "),
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
