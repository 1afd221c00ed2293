// The kinds of files that the program reads, and as what. This is the only such list: dialogs,
// dropped files, thumbnails, commands and `holomorph formats` use it.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "system/file.h"

namespace holomorph {

/// What a file can be opened as.
enum class FileContent {
  scene,
  picture,
  film,     ///< a picture that moves
  path,     ///< a cage, a pose or an outline
  surface,  ///< triangles in space
  points
};

struct FileKind {
  std::vector<std::string> extensions;  ///< in lower case and with the dot
  std::vector<FileContent> contents;
  std::string needs = {};  ///< the program that must be installed to open it as the first of these
};
const std::vector<FileKind>& file_kinds();

/// Whether files of a kind can be opened as this.
bool can_open_as(const FileKind& kind, FileContent content);
/// The extensions of all files that can be opened as one of these.
std::vector<std::string> extensions_of(std::initializer_list<FileContent> contents);
/// Whether a file's extension is that of files that can be opened as this.
bool is_named_as(const Path& file, FileContent content);

}  // namespace holomorph
