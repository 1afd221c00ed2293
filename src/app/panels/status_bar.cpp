// The left part says what to do or what is wrong. The right part shows figures and is never cut
// off.
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/panels/map_panel.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "scene/report.h"

namespace holomorph {
namespace {

/// A text in the right part of the bar, drawn from right to left.
class RightPart {
 public:
  RightPart(float right, float top, float height) : x_(right), top_(top), height_(height) {}
  float left() const { return x_; }

  void text(ImU32 color, const std::string& text) {
    x_ -= text_size(Type::caption, text).x;
    draw_text(*ImGui::GetWindowDrawList(), Type::caption,
              {x_, top_ + (height_ - font(Type::caption)->FontSize) / 2}, color, text);
  }
  /// Makes what was drawn left of `end` a button.
  bool pressed(const char* name, float end) const {
    ImGui::SetCursorScreenPos({x_, top_});
    const bool result = ImGui::InvisibleButton(name, {end - x_, height_});
    name_item(name);
    draw_focus_ring(px(4));
    return result;
  }
  void gap(float units = 8) { x_ -= px(units); }
  void line() {
    gap(10);
    const float middle = top_ + height_ / 2;
    ImGui::GetWindowDrawList()->AddLine({x_, middle - px(7)}, {x_, middle + px(7)},
                                        faded(theme_colors().edge));
    gap(10);
  }
  void action(const char* id, const char* icon, Workspace& workspace) {
    const float side = px(24);
    x_ -= side;
    ImGui::SetCursorScreenPos({x_, std::round(top_ + (height_ - side) / 2)});
    if (icon_button(id, icon, "", false, side, Type::caption)) run(id, workspace);
    tooltip_of(workspace.actions.named(id));
  }

 private:
  float x_, top_, height_;
};

std::string pixels(Complex z) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0f, %.0f px", std::round(z.real()) + 0.0,
                std::round(z.imag()) + 0.0);
  return text;
}

void draw_figures(RightPart& right, Workspace& workspace, const StatusLine& status) {
  const ThemeColors& c = theme_colors();
  right.gap(4);
  right.action("view.fit", icon_named("fit"), workspace);
  right.action("view.zoom_in", icon_named("add"), workspace);
  right.gap(2);
  char zoom[24];
  std::snprintf(zoom, sizeof zoom, "%.0f %%", 100 * workspace.display.viewport.zoom);
  right.text(c.text, zoom);
  right.gap(2);
  right.action("view.zoom_out", icon_named("minus"), workspace);
  if (status.draft) {
    right.line();
    right.text(c.muted, "Draft");
  } else if (const StateText state = fold_state(workspace); !state.text.empty()) {
    right.line();
    const bool good = state.color == c.success;
    const float end = right.left();
    right.text(state.color, state.text);
    right.gap(4);
    right.text(state.color, good ? icon_named("check") : icon_named("warning"));
    if (right.pressed("fold state", end)) run("view.fold", workspace);
    tooltip_of(workspace.actions.named("view.fold"));
  }
  // The position comes last, because it disappears when the pointer leaves the canvas.
  if (status.cursor) {
    right.line();
    if (status.cursor_at_rest && std::abs(*status.cursor_at_rest - *status.cursor) >= 0.5) {
      right.text(c.muted, " from " + pixels(*status.cursor_at_rest));
    }
    right.text(c.muted, pixels(*status.cursor));
  }
}

}  // namespace

void draw_status_bar(Workspace& workspace, const StatusLine& status, const PanelSizes& sizes) {
  const ThemeColors& c = theme_colors();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float height = static_cast<float>(sizes.status), top = display.y - height;
  begin_panel("Status", {0, top}, display, c.chrome, {0, 0}, ImGuiWindowFlags_NoScrollbar);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine({0, top}, {display.x, top}, faded(c.line));
  RightPart right(display.x - px(4), top, height);
  if (!workspace.document.empty()) draw_figures(right, workspace, status);
  float x = px(12);
  const float end = right.left() - px(12),
              text_top = top + (height - font(Type::caption)->FontSize) / 2;
  const auto fits = [](const std::string& text, float room) {
    const ScopedFont small(Type::caption);
    return fitted_text(text, room);
  };
  const auto draw_left = [&](ImU32 color, const std::string& text) {
    const std::string fitted = fits(text, end - x);
    draw_text(list, Type::caption, {x, text_top}, color, fitted);
    x += text_size(Type::caption, fitted).x + px(12);
  };
  const auto button = [&](const char* label) {
    ImGui::SetCursorScreenPos({x, std::round(top + (height - px(24)) / 2)});
    const bool pressed = small_button(label);
    x = ImGui::GetItemRectMax().x + px(12);
    return pressed;
  };
  const LiveMap& map = workspace.map();
  if (map.error()) {
    draw_left(c.error, std::string(icon_named("warning")) + " " + map.error()->what());
    if (const auto where = map.error()->where(); where && button("Show me"))
      workspace.center_on(*where);
    const Deformation& deformation = workspace.shown.deformation();
    if (deformation.rest.has_holes() && !method_named(deformation.method).allows_holes &&
        button("Fill holes"))
      run("cage.fill", workspace);
  } else {
    const auto state = map.map().status;
    if (map.has_map() && state == SampledMap::Status::infeasible)
      draw_left(c.warning, std::string(icon_named("warning")) + " " + map.map().note);
    if (x < end) {
      list.PushClipRect({0, top}, {end, display.y}, true);
      draw_hint(list, {x, top}, height, c.muted, fits(status.hint, end - x - px(24)));
      list.PopClipRect();
    }
  }
  end_panel();
}

}  // namespace holomorph
