// Which panel takes the keys, where it is not the canvas (F6, and F10 for the menu bar).
#pragma once

namespace holomorph {

class PanelFocus {
 public:
  /// The next of the panels that are shown, and after the last one the canvas again.
  void next();
  /// The menu bar, which is being drawn, with this menu chosen.
  void go_to_menu(const char* name);
  /// Whether a panel has the keys.
  bool held() const { return panel_ != nullptr; }
  /// The canvas has them again.
  void leave();
  /// Once a frame: lets go of a panel that is gone, and of the menu bar when an entry was chosen;
  /// goes along where a click has led to another one.
  void look();

 private:
  const char* panel_ = nullptr;  ///< the name of its window
  bool chooses_ = false;         ///< Enter or Space was pressed in a menu
};

}  // namespace holomorph
