// Moves the keyboard focus between the canvas and the panels (F6, or F10 for the menu bar).
#pragma once

namespace holomorph {

class PanelFocus {
 public:
  /// Moves the keyboard focus to the next visible panel, or to the canvas after the last panel.
  void next();
  /// Moves the focus to a menu of the menu bar. Call this while the menu bar is being drawn.
  void go_to_menu(const char* name);
  /// Whether a panel has the focus.
  bool held() const { return panel_ != nullptr; }
  /// Returns the focus to the canvas.
  void leave();
  /// Returns the focus to the canvas if the focused panel is no longer visible or an entry of the
  /// menu bar was chosen. If the user has clicked another panel, moves the focus there. Call this
  /// once per frame.
  void look();

 private:
  const char* panel_ = nullptr;  ///< name of the panel's window; null: the canvas
  bool chooses_ = false;         ///< Enter or Space was pressed in a menu
};

}  // namespace holomorph
