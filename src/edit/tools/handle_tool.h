// What the tools that pick and drag handles share: picking, dragging, the ring of a pin.
#pragma once

#include "edit/tools/tool.h"

namespace holomorph {

class HandleTool : public Tool {
 public:
  void cancel(Workspace& workspace) override;
  bool busy() const override { return drag_.active() || ring_.active(); }
  bool selects() const override { return true; }
  bool scroll(const Input& input, Workspace& workspace) override {
    return ring_.scroll(input, workspace);
  }
  ToolOverlay overlay() const override;

 protected:
  /// Continues a drag of handles or of the ring. Returns whether there is one.
  bool follow(const Input& input, Workspace& workspace);
  /// Finds the handle under the pointer.
  void find(const Input& input, const Workspace& workspace);
  /// A press on the ring turns it; on a handle, Alt deletes it, and otherwise it is selected and
  /// dragged. Returns whether the press was on either.
  bool press(const Input& input, Workspace& workspace);
  /// Starts a gesture of the tool's own on the selected handle under the pointer, in place of a
  /// drag. Returns whether there is one.
  virtual bool start_gesture(const Input&, Workspace&) { return false; }

  HandleDrag drag_;
  PinRing ring_;  ///< shown by tools that call its `hover`
  std::optional<Handle> hover_;

 private:
  /// Shift adds the handle under the pointer or removes it. Returns whether it is selected.
  bool select(const Input& input, Workspace& workspace);
};

}  // namespace holomorph
