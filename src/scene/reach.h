// Which files a scene may have read.
#pragma once

#include <vector>

#include "scene/file.h"

namespace holomorph {

/// A scene of a stranger may name any file: without more it reaches what lies in its own folder,
/// where links lead as well.
struct Reach {
  bool everywhere = false;
  std::vector<Path> folders = {};  ///< absolute; what lies in one of these, but not deeper

  /// Whether a scene in a folder reaches an absolute file. Looks at the disk in the scene's folder
  /// alone, so that the answer says nothing of what is elsewhere.
  bool covers(const Path& file, const Path& scene_folder) const;
};

}  // namespace holomorph
