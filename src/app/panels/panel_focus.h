// Which panel takes the keys instead of the canvas (F6, and F10 for the menu bar).
#pragma once

namespace holomorph {

class PanelFocus {
 public:
  /// Gives the keys to the next visible panel, or to the canvas after the last panel.
  void next();
  /// Gives the keys to a menu of the menu bar. To be called while the menu bar is being drawn.
  void go_to_menu(const char* name);
  /// Whether a panel takes the keys.
  bool held() const { return panel_ != nullptr; }
  /// Gives the keys back to the canvas.
  void leave();
  /// To be called once per frame. Gives the keys back to the canvas if their panel is no longer
  /// visible or an entry of the menu bar was chosen. If the user has clicked another panel, gives
  /// the keys to that panel.
  void look();

 private:
  const char* panel_ = nullptr;  ///< name of the panel's window; null: the canvas
  bool chooses_ = false;         ///< Enter or Space was pressed in a menu
};

}  // namespace holomorph
