#include "app/canvas/navigation.h"

#include <imgui.h>

#include <cmath>
#include <utility>

namespace holomorph {

Navigation::Outcome Navigation::navigate(Input& input, bool space, bool for_canvas,
                                         Viewport& viewport) {
  const ImGuiIO& io = ImGui::GetIO();
  if (input.inside && (ImGui::IsMouseClicked(2) || (space && input.pressed))) panning_ = true;
  if (!ImGui::IsMouseDown(2) && !(space && input.down)) panning_ = false;
  if (panning_) viewport.pan_px({io.MouseDelta.x, io.MouseDelta.y});
  if (input.wheel != 0) viewport.zoom_at(input.px, std::pow(1.15, input.wheel));
  if (space && !std::exchange(space_, true)) space_used_ = !for_canvas;
  space_used_ = space_used_ || panning_;
  Outcome outcome;
  outcome.moved = panning_ || input.wheel != 0;
  outcome.tapped = !space && std::exchange(space_, false) && !space_used_;
  if (panning_ || space) input.inside = input.pressed = input.double_clicked = false;
  input.position = viewport.plane_at_px(input.px);
  return outcome;
}

}  // namespace holomorph
