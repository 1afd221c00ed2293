// A press acts on the handle under the pointer, or on the ring if no handle is there.
#include "edit/tools/handle_tool.h"

namespace holomorph {

bool HandleTool::follow(const Input& input, Workspace& workspace) {
  if (ring_.active())
    ring_.follow(input, workspace);
  else if (drag_.active())
    drag_.follow(input, workspace);
  else
    return false;
  return true;
}

void HandleTool::find(const Input& input, const Workspace& workspace) {
  hover_ = input.inside ? handle_at(workspace, input.px) : std::nullopt;
}

bool HandleTool::press(const Input& input, Workspace& workspace) {
  if (ring_.hovered() && !hover_) {
    ring_.start(input, workspace);
    return true;
  }
  if (!hover_) return false;
  if (erase_with_alt(input, *hover_, workspace)) {
    hover_.reset();
  } else if (select(input, workspace) && !start_gesture(input, workspace)) {
    drag_.start(input, *hover_, workspace.selection, workspace.shown.deformation());
    if (has_ring()) ring_.hover(input, workspace);  // it goes to the pin that is dragged
  }
  return true;
}

bool HandleTool::select(const Input& input, Workspace& workspace) {
  Selection& selection = workspace.selection;
  if (input.mods.shift && selection.erase(*hover_) > 0) return false;
  if (!input.mods.shift && !selection.contains(*hover_)) selection.clear();
  selection.insert(*hover_);
  return true;
}

void HandleTool::cancel(Workspace& workspace) {
  drag_.cancel(workspace);
  ring_.cancel(workspace);
  hover_.reset();
}

ToolOverlay HandleTool::overlay() const {
  ToolOverlay overlay;
  overlay.guides = drag_.guides();
  overlay.hover = hover_;
  overlay.ring = ring_.pin();
  overlay.ring_hovered = ring_.hovered() || ring_.active();
  return overlay;
}

}  // namespace holomorph
