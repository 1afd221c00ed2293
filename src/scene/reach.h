// Which files a scene may have read.
#pragma once

#include <vector>

#include "system/file.h"

namespace holomorph {

/// A scene of a stranger may name any file: without more it reaches what lies in its own folder.
/// Links count by where they lead.
struct Reach {
  bool everywhere = false;
  std::vector<Path> folders = {};  ///< absolute; files in one of these, but not deeper

  /// Whether a scene in a folder reaches an absolute file. Looks at the disk in these folders
  /// alone, so that the answer says nothing of what is elsewhere.
  bool covers(const Path& file, const Path& scene_folder) const;
};

}  // namespace holomorph
