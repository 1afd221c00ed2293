// The drag that select and pin tools share.
#include "edit/tool.h"

namespace holomorph {

bool HandleDrag::follow(const Input& input, Workspace& workspace, const std::string& label) {
  if (!moving_ && std::abs(input.px - start_px_) >= kDragThresholdPx) moving_ = true;
  if (moving_) {
    Complex by = input.position - start_;
    if (input.mods.shift)
      by =
          std::abs(by.real()) > std::abs(by.imag()) ? Complex(by.real(), 0) : Complex(0, by.imag());
    workspace.preview = moved(scene_, what_, by, workspace.layer);
  }
  if (!input.released && input.down) return false;
  active_ = false;
  if (workspace.preview) workspace.commit(label, *workspace.preview);
  return true;
}

}  // namespace holomorph
