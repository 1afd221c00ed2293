// The search over everything that can be done (Ctrl+Shift+P): actions and methods.
#pragma once

#include "edit/actions.h"

namespace holomorph {

class Palette {
 public:
  void show();
  bool open() const { return open_; }
  void draw(Workspace& workspace, double scale);

 private:
  std::string text_;
  int chosen_ = 0;  ///< among the rows that are shown
  bool open_ = false, opening_ = false;
};

}  // namespace holomorph
