// The inspector's section with the list of layers.
#pragma once

#include "app/thumbnails.h"
#include "edit/workspace.h"

namespace holomorph {

class LayerPanel {
 public:
  /// Opens a text field for the edited layer's name.
  void rename(const Scene& scene);
  /// Call this when another document is opened.
  void forget() { renamed_id_ = 0; }
  /// Whether a name is being typed. Its field must then be visible.
  bool is_renaming() const { return renamed_id_ != 0; }
  void draw(Workspace& workspace, Thumbnails& thumbnails);

 private:
  void draw_row(Workspace& workspace, size_t layer, Thumbnails& thumbnails);
  void draw_ink(Workspace& workspace);
  /// Whether the edited layer is clipped to the one below it.
  void draw_clipping(Workspace& workspace);
  void draw_name(Workspace& workspace, size_t layer, float width);

  int renamed_id_ = 0;  ///< id of the layer whose name is being typed; 0: none
  std::string name_;
  bool focus_field_ = false;
};

}  // namespace holomorph
