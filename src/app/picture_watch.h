// Pictures that another program changes while they are open.
#pragma once

#include <map>

#include "edit/workspace.h"

namespace holomorph {

/// Reads them again, beside the window, when their files are left alone, and what could not be read
/// when its file is another one; what cannot be read stays as it was until it changes once more.
class PictureWatch {
 public:
  explicit PictureWatch(Workspace& workspace) : workspace_(workspace) {}

  /// Called now and then: looks at the files, and takes over what was read.
  void look();
  /// The workspace has another document.
  void forget();

 private:
  using Time = std::filesystem::file_time_type;
  using Changed = std::vector<std::pair<ImageReference, Time>>;
  Changed changed();
  void start(const Changed& changed);
  void take();

  Workspace& workspace_;
  Changed changing_;                   ///< when it was looked last: it may still be being written
  std::map<std::string, Time> tried_;  ///< when the files that could not be read were written
  std::shared_ptr<std::vector<std::pair<ImageReference, Picture>>> read_;
  std::unique_ptr<Job> reading_;
};

}  // namespace holomorph
