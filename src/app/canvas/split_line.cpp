#include "app/canvas/split_line.h"

#include <algorithm>
#include <cmath>

namespace holomorph {

void SplitLine::drag(Input& input, DisplayOptions& display) {
  if (!display.split || !input.down) dragging_ = false;
  if (!display.split) return;
  const Viewport& view = display.viewport;
  const double off = input.px.real() - view.left - *display.split * view.width;
  const bool over = input.inside && std::abs(off) < 0.6 * display.handle_px;
  if (over && input.pressed) dragging_ = true;
  if (dragging_) display.split = std::clamp((input.px.real() - view.left) / view.width, 0.02, 0.98);
  if (over || dragging_) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    input.inside = input.pressed = input.double_clicked = false;
  }
}

bool is_before(const DisplayOptions& display, Complex px) {
  const Viewport& view = display.viewport;
  return display.split && px.real() < view.left + *display.split * view.width;
}

void draw_split_line(const DisplayOptions& display, const OverlayStyle& style) {
  if (!display.split) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Viewport& view = display.viewport;
  const float s = static_cast<float>(style.scale), top = static_cast<float>(view.top),
              bottom = static_cast<float>(view.top + view.height),
              x = static_cast<float>(view.left + *display.split * view.width);
  list.AddLine({x, top}, {x, bottom}, style.colors.outline, 4 * s);
  list.AddLine({x, top}, {x, bottom}, style.colors.selected, 2 * s);
  const float middle = (top + bottom) / 2;
  list.AddRectFilled({x - 5 * s, middle - 18 * s}, {x + 5 * s, middle + 18 * s},
                     style.colors.outline, 5 * s);
  list.AddRectFilled({x - 3.5f * s, middle - 16.5f * s}, {x + 3.5f * s, middle + 16.5f * s},
                     style.colors.selected, 3.5f * s);
  const float height = ImGui::GetTextLineHeight();
  for (const auto& [text, left] : {std::pair("Before", true), {"After", false}}) {
    const float width = ImGui::CalcTextSize(text).x, pad = 8 * s,
                at = left ? x - width - 3 * pad : x + pad;
    list.AddRectFilled({at, bottom - height - 3 * pad}, {at + width + 2 * pad, bottom - pad},
                       style.colors.panel, 4 * s);
    list.AddText({at + pad, bottom - height - 2 * pad}, style.colors.text, text);
  }
}

}  // namespace holomorph
