// The one table of what can be opened. Dialogs, dropped files and `holomorph formats` use it.
#include "scene/formats/file_kinds.h"

#include <algorithm>

#include "system/text.h"

namespace holomorph {

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> all{
      {{".json", ".holomorph"}, {FileContent::scene}},
      {{".png"}, {FileContent::picture}},
      {{".jpg", ".jpeg"}, {FileContent::picture}},
      {{".webp"}, {FileContent::picture}},
      {{".tif", ".tiff"}, {FileContent::picture}},
      {{".ora"}, {FileContent::picture}},
      {{".exr"}, {FileContent::picture}},
      {{".psd"}, {FileContent::picture}},
      {{".gif"}, {FileContent::picture}},
      {{".bmp"}, {FileContent::picture}},
      {{".tga"}, {FileContent::picture}},
      {{".mp4"}, {FileContent::film}, "ffmpeg"},
      {{".m4v"}, {FileContent::film}, "ffmpeg"},
      {{".mov"}, {FileContent::film}, "ffmpeg"},
      {{".mkv"}, {FileContent::film}, "ffmpeg"},
      {{".webm"}, {FileContent::film}, "ffmpeg"},
      {{".avi"}, {FileContent::film}, "ffmpeg"},
      {{".svg", ".svgz"}, {FileContent::picture, FileContent::path}, "rsvg-convert"},
      {{".obj"}, {FileContent::surface}},
      {{".csv"}, {FileContent::points}}};
  return all;
}

bool can_open_as(const FileKind& kind, FileContent content) {
  return std::ranges::find(kind.contents, content) != kind.contents.end();
}

std::vector<std::string> extensions_of(std::initializer_list<FileContent> contents) {
  std::vector<std::string> found;
  for (const FileKind& kind : file_kinds())
    if (std::ranges::any_of(contents, [&](FileContent each) { return can_open_as(kind, each); }))
      found.insert(found.end(), kind.extensions.begin(), kind.extensions.end());
  return found;
}

bool is_named_as(const Path& file, FileContent content) {
  const std::string extension = lower_case(file.extension().string());
  return std::ranges::any_of(file_kinds(), [&](const FileKind& kind) {
    return can_open_as(kind, content) &&
           std::ranges::find(kind.extensions, extension) != kind.extensions.end();
  });
}

}  // namespace holomorph
