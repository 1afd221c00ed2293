// The common base of tools that pick and drag handles: picking, dragging, the ring of a pin.
#pragma once

#include "edit/tools/tool.h"

namespace holomorph {

class HandleTool : public Tool {
 public:
  void cancel(Workspace& workspace) override;
  bool busy() const override { return drag_.active() || ring_.active(); }
  bool selects() const override { return true; }
  bool scroll(const Input& input, Workspace& workspace) override {
    return has_ring() && ring_.scroll(input, workspace);
  }
  ToolOverlay overlay() const override;

 protected:
  /// Continues the current drag of handles or of the ring. Returns false if there is none.
  bool follow(const Input& input, Workspace& workspace);
  /// Finds the handle under the pointer.
  void find(const Input& input, const Workspace& workspace);
  /// Handles a press. On the ring, it starts a rotation. On a handle, it deletes the handle if Alt
  /// is held; otherwise it selects the handle and starts a drag. Returns whether the press was on
  /// the ring or a handle.
  bool press(const Input& input, Workspace& workspace);
  /// Starts the tool's own gesture, instead of a drag, on the selected handle under the pointer.
  /// Returns false if the tool has no gesture for it.
  virtual bool start_gesture(const Input&, Workspace&) { return false; }

  /// Whether the tool shows the ring of the selected pin. Such a tool must call PinRing::hover.
  virtual bool has_ring() const { return false; }

  HandleDrag drag_;
  PinRing ring_;
  std::optional<Handle> hover_;

 private:
  /// Selects the handle under the pointer; with Shift, adds it to the selection or removes it.
  /// Returns whether it is now selected.
  bool select(const Input& input, Workspace& workspace);
};

}  // namespace holomorph
