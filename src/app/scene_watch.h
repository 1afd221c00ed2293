// Notices when another program changes or removes the open scene's file.
#pragma once

#include "scene/document.h"

namespace holomorph {

class SceneWatch {
 public:
  enum class Change { none, changed, gone };

  /// Reports each change once. Call this regularly. A changed file is reported when two consecutive
  /// calls find the same modification time. Before that, the other program may still be writing it.
  Change look(Document& document);

 private:
  using Time = std::filesystem::file_time_type;
  std::optional<Time> seen_;      ///< modification time found by the last call
  std::optional<Time> reported_;  ///< modification time of the last reported change
};

}  // namespace holomorph
