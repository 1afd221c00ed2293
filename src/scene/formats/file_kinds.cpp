// The one table of what can be opened. Dialogs, dropped files and `holomorph formats` use it.
#include "scene/formats/file_kinds.h"

#include <algorithm>

#include "system/text.h"

namespace holomorph {

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> all{{"Scene", {".json", ".holomorph"}, FileContent::scene},
                                         {"PNG", {".png"}, FileContent::picture},
                                         {"JPEG", {".jpg", ".jpeg"}, FileContent::picture},
                                         {"WebP", {".webp"}, FileContent::picture},
                                         {"TIFF", {".tif", ".tiff"}, FileContent::picture},
                                         {"OpenRaster", {".ora"}, FileContent::picture},
                                         {"PSD", {".psd"}, FileContent::picture},
                                         {"GIF", {".gif"}, FileContent::picture},
                                         {"BMP", {".bmp"}, FileContent::picture},
                                         {"TGA", {".tga"}, FileContent::picture},
                                         {"SVG", {".svg"}, FileContent::path},
                                         {"Wavefront OBJ", {".obj"}, FileContent::surface},
                                         {"CSV", {".csv"}, FileContent::points}};
  return all;
}

std::vector<std::string> extensions_of(std::initializer_list<FileContent> contents) {
  std::vector<std::string> found;
  for (const FileKind& kind : file_kinds())
    if (std::ranges::find(contents, kind.content) != contents.end())
      found.insert(found.end(), kind.extensions.begin(), kind.extensions.end());
  return found;
}

bool is_named_as(const Path& file, FileContent content) {
  const std::string extension = lower_case(file.extension().string());
  return std::ranges::any_of(file_kinds(), [&](const FileKind& kind) {
    return kind.content == content &&
           std::ranges::find(kind.extensions, extension) != kind.extensions.end();
  });
}

}  // namespace holomorph
