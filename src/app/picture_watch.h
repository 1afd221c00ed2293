// Watches for pictures that another program changes while they are open.
#pragma once

#include <map>

#include "edit/workspace.h"

namespace holomorph {

/// Reads changed pictures again on another thread, once their files are no longer being written.
/// Pictures that could not be read are tried again when their files change. A picture whose new
/// file cannot be read stays as it was until the file changes again.
class PictureWatch {
 public:
  explicit PictureWatch(Workspace& workspace) : workspace_(workspace) {}

  /// To be called regularly. Looks at the files, and takes over pictures that have been read.
  void look();
  /// To be called when the workspace has another document.
  void forget();

 private:
  using Time = std::filesystem::file_time_type;
  using Changed = std::vector<std::pair<ImageReference, Time>>;
  Changed changed();
  void start(const Changed& changed);
  void take_over();

  Workspace& workspace_;
  Changed changing_;                   ///< found by the last look: may still be being written
  std::map<std::string, Time> tried_;  ///< change times of the files that could not be read
  std::shared_ptr<std::vector<std::pair<ImageReference, Picture>>> read_;
  std::unique_ptr<Job> reading_;
};

}  // namespace holomorph
