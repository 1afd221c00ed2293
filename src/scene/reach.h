// The set of files that the program may read for a scene.
#pragma once

#include <vector>

#include "system/file.h"

namespace holomorph {

/// The files within reach of a scene. An untrusted scene may name any file, but by default only the
/// files in its own folder and its subfolders are in reach. A link is in reach if its target is.
struct Reach {
  bool everywhere = false;
  std::vector<Path> folders = {};  ///< absolute; allows the files directly in them

  /// Whether a scene in a folder may read a file, given by its absolute path. The check accesses
  /// only the allowed folders. The result therefore reveals nothing about files elsewhere.
  bool covers(const Path& file, const Path& scene_folder) const;
};

}  // namespace holomorph
