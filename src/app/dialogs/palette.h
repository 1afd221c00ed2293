// The search over everything that can be done (Ctrl+Shift+P): actions, methods, what the method can
// be set to, and the looks of the interface.
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
  int chosen_ = 0;  ///< among the rows that are shown
  bool open_ = false, opening_ = false;
};

}  // namespace holomorph
