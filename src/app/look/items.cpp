// Tooltips are drawn here only, so that they look alike and never cover a menu.
#include "app/look/items.h"

#include <imgui_internal.h>

namespace holomorph {
namespace {

constexpr float kTooltipWidth = 26;  ///< in units of the font size
bool tooltips_suppressed = false;

/// Whether the topmost popup is a menu or a list, not a dialog.
bool in_menu() {
  const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
  return !open.empty() && open.back().Window &&
         (open.back().Window->Flags & ImGuiWindowFlags_Modal) == 0;
}

/// Whether items are disabled at this point, between BeginDisabled and EndDisabled.
bool is_disabled() {
  return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
}

bool begin_tooltip() {
  if (tooltips_suppressed || in_menu() ||
      !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    return false;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(12), px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(8));
  // What is disabled is faint, but its tooltip is not.
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, is_disabled()
                                               ? ImGui::GetCurrentContext()->DisabledAlphaBackup
                                               : ImGui::GetStyle().Alpha);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipWidth * ImGui::GetFontSize());
  return true;
}

void end_tooltip() {
  ImGui::PopTextWrapPos();
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  draw_shadow(*ImGui::GetWindowDrawList(), at, at + size, px(12), 0.32f);
  ImGui::EndTooltip();
  ImGui::PopStyleVar(3);
}

std::map<std::string, ImVec4>& boxes() {
  static std::map<std::string, ImVec4> the_boxes;
  return the_boxes;
}

}  // namespace

TabStop::TabStop() {
  ImGui::PushItemFlag(ImGuiItemFlags_NoTabStop, false);
}
TabStop::~TabStop() {
  ImGui::PopItemFlag();
}

void draw_focus_ring(float rounding) {
  const ImGuiContext& imgui = *ImGui::GetCurrentContext();
  if (imgui.NavDisableHighlight || imgui.NavId == 0 || imgui.NavId != ImGui::GetItemID()) return;
  const float out = px(2) + 1;
  const ImVec2 from = ImGui::GetItemRectMin() - ImVec2(out, out),
               to = ImGui::GetItemRectMax() + ImVec2(out, out);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(from - ImVec2(2, 2), to + ImVec2(2, 2), false);
  list.AddRect(from, to, faded(theme_colors().accent), rounding + out, 0, px(2));
  list.PopClipRect();
}

void tooltip(const std::string& text) {
  if (text.empty() || !begin_tooltip()) return;
  ImGui::TextUnformatted(text.c_str());
  end_tooltip();
}

void tooltip_of(const Action& action) {
  const bool disabled = is_disabled();
  if (!begin_tooltip()) return;
  ImGui::TextUnformatted(action.label.c_str());
  if (!action.keys.empty()) {
    ImGui::SameLine(0, px(8));
    const std::string key = text_of(action.keys[0]);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float width =
        draw_key_cap(list, ImGui::GetCursorScreenPos(), ImGui::GetTextLineHeight(), key);
    ImGui::Dummy({width, ImGui::GetTextLineHeight()});
  }
  for (const char* text : {action.hint, disabled ? action.needs : ""}) {
    if (!*text) continue;
    const ScopedFont small(Type::caption);
    ImGui::PushStyleColor(ImGuiCol_Text, color_of(theme_colors().muted));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
  }
  end_tooltip();
}

void suppress_tooltips(bool suppressed) {
  tooltips_suppressed = suppressed;
}

const std::map<std::string, ImVec4>& item_boxes() {
  return boxes();
}

void name_item(const std::string& name) {
  // The first frame of a list only measures it. It is not drawn, and its items are elsewhere.
  if (ImGui::GetCurrentContext()->CurrentWindow->Hidden) return;
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  boxes().try_emplace(name, from.x, from.y, to.x, to.y);
}

void forget_item_boxes() {
  boxes().clear();
}

}  // namespace holomorph
