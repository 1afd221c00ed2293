// The inspector's list of layers, and what is behind them.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

class LayerPanel {
 public:
  /// The edited layer's name is typed from now on.
  void rename(const Scene& scene);
  /// Another document.
  void forget() { named_ = 0; }
  /// Whether a name is typed, which has to be seen.
  bool naming() const { return named_ != 0; }
  void draw(Workspace& workspace, double scale);

 private:
  void draw_row(Workspace& workspace, size_t layer, float s);
  void draw_name(Workspace& workspace, size_t layer);

  int named_ = 0;  ///< the layer whose name is typed; 0: none
  std::string name_;
  bool starts_ = false;
};

}  // namespace holomorph
