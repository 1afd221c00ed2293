// Which panel takes the keys, where it is not the canvas (F6).
#pragma once

namespace holomorph {

class PanelFocus {
 public:
  /// The next of the panels that are shown, and after the last one the canvas again.
  void next();
  /// Whether a panel has the keys.
  bool held() const { return panel_ != nullptr; }
  /// The canvas has them again.
  void leave();
  /// Once a frame: lets go of a panel that is gone, and goes along where a click has led to
  /// another.
  void look();

 private:
  const char* panel_ = nullptr;  ///< the name of its window
};

}  // namespace holomorph
