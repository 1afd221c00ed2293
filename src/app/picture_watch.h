// Reloads open pictures when another program changes their files.
#pragma once

#include <map>

#include "edit/workspace.h"

namespace holomorph {

/// Reads changed pictures on another thread once their files are no longer being written. If a
/// changed file cannot be read, the old picture is kept until the file changes again. Pictures that
/// could not be read at all are also tried again when their files change.
class PictureWatch {
 public:
  explicit PictureWatch(Workspace& workspace) : workspace_(workspace) {}

  /// Checks the files and puts pictures that were read into the document. Call this regularly.
  void look();
  /// Call this when the workspace has switched to another document.
  void forget();

 private:
  using Time = std::filesystem::file_time_type;
  using Changed = std::vector<std::pair<ImageReference, Time>>;
  Changed changed();
  void start(const Changed& changed);
  void take_over();

  Workspace& workspace_;
  Changed changing_;  ///< changed at the last check; other programs may still be writing them
  std::map<std::string, Time> tried_;  ///< modification times of the files when last tried
  std::shared_ptr<std::vector<std::pair<ImageReference, Picture>>> read_;
  std::unique_ptr<Job> reading_;
};

}  // namespace holomorph
