// The bar of tools at the left edge: tools for the pose, tools for shapes, and what is on or off.
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

#include "app/look/items.h"
#include "app/look/surfaces.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

/// The actions from top to bottom; an empty string is a line. Those after "|" are at the bottom.
constexpr const char* kTools[] = {"tool.select",
                                  "tool.pin",
                                  "tool.brush",
                                  "",
                                  "tool.pen",
                                  "tool.stroke",
                                  "tool.outline",
                                  "tool.angle",
                                  "",
                                  "edit.soft",
                                  "edit.symmetry",
                                  "edit.snap",
                                  "|",
                                  "view.timeline",
                                  "help.keys"};

bool is_tool(std::string_view id) {
  return id.substr(0, 5) == "tool.";
}

void draw_tool(const char* id, Workspace& workspace, float height) {
  const ThemeColors& c = theme_colors();
  const Action& action = workspace.actions.named(id);
  const bool on = action.checked && action.checked(workspace), active = on && is_tool(id);
  const float width = px(36), radius = px(8);
  ImGui::BeginDisabled(!action.enabled(workspace));
  const bool pressed = ImGui::InvisibleButton(id, {width, height});
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImU32 fill = 0, ink = hovered ? c.text : c.muted;
  if (active) {
    fill = hovered ? blended(c.accent_fill, IM_COL32_BLACK, 0.08f) : c.accent_fill;
    ink = c.on_accent;
  } else if (on) {
    fill = c.accent_tint;
    ink = c.accent;
  } else if (hovered) {
    fill = c.hover;
  }
  if (fill) list.AddRectFilled(from, to, faded(fill), radius);
  if (on && !active) {  // a bar at the edge shows the state without color
    const float middle = (from.y + to.y) / 2;
    list.AddRectFilled({from.x - px(6), middle - px(8)}, {from.x - px(3), middle + px(8)},
                       faded(c.accent), px(2), ImDrawFlags_RoundCornersRight);
    if (has_high_contrast()) list.AddRect(from, to, faded(c.accent), radius, 0, px(2));
  }
  draw_icon(list, action.icon, (from + to) * 0.5f, ink);
  draw_focus_ring(radius);
  name_item(id);
  tooltip_of(action);
  ImGui::EndDisabled();
  if (pressed) run(id, workspace);
}

}  // namespace

void draw_tool_bar(Workspace& workspace, const PanelSizes& sizes) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float top = static_cast<float>(sizes.menu),
              bottom = display.y - static_cast<float>(sizes.status),
              width = static_cast<float>(sizes.toolbar);
  begin_panel("Toolbar", {0, top}, {width, bottom}, theme_colors().chrome, {6, 8},
              ImGuiWindowFlags_NoScrollbar);
  if (has_high_contrast())
    ImGui::GetWindowDrawList()->AddLine({width - 1, top}, {width - 1, bottom},
                                        faded(theme_colors().line));
  // Shrink the tools until all of them fit into the height.
  const float gap = px(4), line = px(9);
  float count = 0, lines = 0;
  for (const std::string_view id : kTools) {
    const bool is_line = id.empty() || id == "|";
    (is_line ? lines : count) += 1;
  }
  const float room = bottom - top - px(16) - lines * (line + gap);
  const float height = std::clamp(std::floor(room / count - gap), px(20), px(36));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, gap});
  for (const char* id : kTools) {
    if (std::string_view(id) == "|") {
      const float rest = 2 * (height + gap);
      ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), bottom - top - px(8) - rest));
    } else if (!*id) {
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const float y = at.y + std::floor(line / 2);
      ImGui::GetWindowDrawList()->AddLine({at.x + px(6), y}, {at.x + px(30), y},
                                          faded(theme_colors().line));
      ImGui::Dummy({px(36), line});
    } else {
      draw_tool(id, workspace, height);
    }
  }
  ImGui::PopStyleVar();
  end_panel();
}

}  // namespace holomorph
