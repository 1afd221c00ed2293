// Which files a scene may have the program read.
#pragma once

#include <vector>

#include "system/file.h"

namespace holomorph {

/// An untrusted scene may name any file. By default it reaches only the files in its own folder.
/// Links are followed: the file that they lead to counts.
struct Reach {
  bool everywhere = false;
  std::vector<Path> folders = {};  ///< absolute; allows the files directly in these folders

  /// Whether a scene in a folder may read a file, given by its absolute path. Only the allowed
  /// folders are accessed, so the answer reveals nothing about files elsewhere.
  bool covers(const Path& file, const Path& scene_folder) const;
};

}  // namespace holomorph
