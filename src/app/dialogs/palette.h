// The command palette (Ctrl+Shift+P): searches actions, methods, settings of the method, and themes
// and sizes of the interface.
#pragma once

#include "app/panels/panels.h"

namespace holomorph {

class Palette {
 public:
  void show();
  bool open() const { return open_; }
  PanelAnswer draw(Workspace& workspace, Preferences& preferences, double scale);

 private:
  std::string text_;
  int chosen_ = 0;  ///< index among the rows that are shown
  bool open_ = false, opening_ = false;
};

}  // namespace holomorph
