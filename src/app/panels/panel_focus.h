// Which panel takes the keys instead of the canvas (F6, and F10 for the menu bar).
#pragma once

namespace holomorph {

class PanelFocus {
 public:
  /// Gives the keys to the next visible panel, and after the last one back to the canvas.
  void next();
  /// Gives the keys to this menu of the menu bar. To be called while the menu bar is being drawn.
  void go_to_menu(const char* name);
  /// Whether a panel takes the keys.
  bool held() const { return panel_ != nullptr; }
  /// Gives the keys back to the canvas.
  void leave();
  /// To be called once per frame. Leaves a panel that is no longer visible, and the menu bar once
  /// an entry was chosen. When a click has led to another panel, that one takes the keys.
  void look();

 private:
  const char* panel_ = nullptr;  ///< the name of its window; null: the canvas
  bool chooses_ = false;         ///< Enter or Space was pressed in a menu
};

}  // namespace holomorph
