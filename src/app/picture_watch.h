// Pictures that another program changes while they are open.
#pragma once

#include <set>

#include "edit/workspace.h"

namespace holomorph {

/// Reads them again, beside the window, when their files are left alone, and what was missing when
/// it is there again; what cannot be read stays as it was until it changes once more.
class PictureWatch {
 public:
  explicit PictureWatch(Workspace& workspace) : workspace_(workspace) {}

  /// Called now and then: looks at the files, and takes over what was read.
  void look();
  /// The workspace has another document.
  void forget();

 private:
  void start(const std::vector<ImageReference>& changed);
  void take();

  Workspace& workspace_;
  std::vector<ImageReference>
      changing_;                  ///< when it was looked last: it may still be being written
  std::set<std::string> absent_;  ///< the files that were missing
  std::shared_ptr<std::vector<std::pair<ImageReference, Picture>>> read_;
  std::unique_ptr<Job> reading_;
};

}  // namespace holomorph
