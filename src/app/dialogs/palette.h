// The command palette (Ctrl+Shift+P). Searches actions, methods, the method's settings, and the
// interface's themes and sizes.
#pragma once

#include "app/panels/panels.h"

namespace holomorph {

class Palette {
 public:
  void show();
  bool open() const { return open_; }
  PanelAnswer draw(Workspace& workspace, Preferences& preferences);

 private:
  std::string text_;
  int chosen_ = 0;  ///< index among the visible rows
  bool open_ = false, opening_ = false;
};

}  // namespace holomorph
