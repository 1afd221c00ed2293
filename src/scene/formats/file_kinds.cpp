// The one table of what can be opened. Dialogs, dropped files and `holomorph formats` use it.
#include "scene/formats/file_kinds.h"

#include <algorithm>

#include "system/text.h"

namespace holomorph {

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> all{{"Scene", {".json", ".holomorph"}, Content::scene},
                                         {"PNG", {".png"}, Content::picture},
                                         {"JPEG", {".jpg", ".jpeg"}, Content::picture},
                                         {"WebP", {".webp"}, Content::picture},
                                         {"TIFF", {".tif", ".tiff"}, Content::picture},
                                         {"OpenRaster", {".ora"}, Content::picture},
                                         {"PSD", {".psd"}, Content::picture},
                                         {"GIF", {".gif"}, Content::picture},
                                         {"BMP", {".bmp"}, Content::picture},
                                         {"TGA", {".tga"}, Content::picture},
                                         {"SVG", {".svg"}, Content::path},
                                         {"Wavefront OBJ", {".obj"}, Content::surface},
                                         {"CSV", {".csv"}, Content::points}};
  return all;
}

std::vector<std::string> extensions_of(std::initializer_list<Content> contents) {
  std::vector<std::string> found;
  for (const FileKind& kind : file_kinds())
    if (std::ranges::find(contents, kind.content) != contents.end())
      found.insert(found.end(), kind.extensions.begin(), kind.extensions.end());
  return found;
}

bool is_named_as(const Path& file, Content content) {
  const std::string extension = lower_case(file.extension().string());
  return std::ranges::any_of(file_kinds(), [&](const FileKind& kind) {
    return kind.content == content &&
           std::ranges::find(kind.extensions, extension) != kind.extensions.end();
  });
}

}  // namespace holomorph
