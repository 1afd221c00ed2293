// Shadows are drawn outside of each surface, so that they can be drawn after its background.
#include "app/look/surfaces.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/look/items.h"
#include "app/look/text.h"

namespace holomorph {
namespace {

void shade_window(float blur, float alpha) {
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  draw_shadow(*ImGui::GetWindowDrawList(), at, at + size, blur, alpha);
}

void push_menu_style() {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(12), px(10)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(12)});
}
void pop_menu_style() {
  ImGui::PopStyleVar(2);
}

}  // namespace

void begin_panel(const char* name, ImVec2 from, ImVec2 to, ImU32 background, ImVec2 padding,
                 ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(from);
  ImGui::SetNextWindowSize(to - from);
  // A scroll bar lies in the padding, so that nothing moves sideways when it appears.
  if (px(padding.x) >= ImGui::GetStyle().ScrollbarSize) {
    ImGui::SetNextWindowContentSize({to.x - from.x - 2 * px(padding.x), 0});
    ImGui::SetNextWindowScroll({0, -1});
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(padding.x), px(padding.y)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(background));
  ImGui::Begin(name, nullptr, kPanel | flags);
  ImGui::PopStyleColor();
  const ImRect& inside = ImGui::GetCurrentWindow()->InnerRect;  // without the scroll bar
  ImGui::PushClipRect(inside.Min, inside.Max, false);
}

void end_panel() {
  ImGui::PopClipRect();
  ImGui::End();
  ImGui::PopStyleVar();
}

namespace {

void begin_surface(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags flags) {
  const float alpha = appearance(ImHashStr(name));
  ImGui::SetNextWindowPos({std::round(at.x), std::round(at.y)}, ImGuiCond_Always, pivot);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * alpha);
  ImGui::Begin(name, nullptr, flags);
  shade_window(px(16), 0.32f);
}

}  // namespace

void begin_card(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags flags) {
  begin_surface(name, at, pivot, kPanel | ImGuiWindowFlags_AlwaysAutoResize | flags);
}

void begin_floating(const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags flags) {
  begin_surface(name, at, pivot, (kPanel & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | flags);
}

void end_card() {
  ImGui::End();
  ImGui::PopStyleVar(3);
}

bool begin_dialog(const std::string& title, const char* id, float width, float height) {
  ImGui::OpenPopup(id);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({std::round(display.x / 2), std::round(display.y / 2)}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  const ImVec2 most = display - ImVec2(px(16), px(16));
  ImGui::SetNextWindowSize(
      {std::min(px(width), most.x), height > 0 ? std::min(px(height), most.y) : 0});
  // A dialog that is too high for the window scrolls.
  ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, most.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(24), px(20)});
  ImGui::PushStyleVar(ImGuiStyleVar_PopupRounding, px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * appearance(ImHashStr(id)));
  ImGui::PushStyleColor(ImGuiCol_PopupBg, color_of(theme_colors().panel));
  const bool open = ImGui::BeginPopupModal(
      id, nullptr,
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
          (height > 0 ? 0 : ImGuiWindowFlags_AlwaysAutoResize));
  ImGui::PopStyleColor();
  if (!open) {
    ImGui::PopStyleVar(5);
    return false;
  }
  shade_window(px(48), 0.45f);
  {
    const ScopedFont large(Type::title);
    ImGui::TextUnformatted(title.c_str(), title.c_str() + std::min(title.find("##"), title.size()));
  }
  ImGui::Dummy({0, px(4)});
  return true;
}

void end_dialog() {
  ImGui::EndPopup();
  ImGui::PopStyleVar(5);
}

void begin_dialog_buttons(float buttons) {
  const ImGuiWindow& window = *ImGui::GetCurrentWindow();
  ImGui::Dummy({0, px(4)});
  const float y = ImGui::GetCursorScreenPos().y;
  ImGui::GetWindowDrawList()->AddLine({window.Pos.x + 1, y}, {window.Pos.x + window.Size.x - 1, y},
                                      faded(theme_colors().line));
  ImGui::Dummy({0, px(4)});
  ImGui::SetCursorPosX(
      std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - buttons));
}

bool begin_menu_popup(const char* id) {
  push_menu_style();
  if (!ImGui::BeginPopup(id)) {
    pop_menu_style();
    return false;
  }
  shade_window(px(12), 0.32f);
  return true;
}

void end_menu_popup() {
  ImGui::EndPopup();
  pop_menu_style();
}

bool begin_menu(const char* label, bool enabled) {
  push_menu_style();
  const bool open = ImGui::BeginMenu(label, enabled);
  if (!open) {
    name_item(std::string("Menu: ") + label);
    pop_menu_style();
    return false;
  }
  shade_window(px(12), 0.32f);
  return true;
}

void end_menu() {
  ImGui::EndMenu();
  pop_menu_style();
}

bool menu_entry(const std::string& label, const std::string& keys, bool checked, bool enabled) {
  const bool chosen = ImGui::MenuItem(label.c_str(), keys.c_str(), checked, enabled);
  name_item("Menu: " + label);
  return chosen;
}

void menu_separator() {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImGuiWindow& window = *ImGui::GetCurrentWindow();
  const float y = at.y + px(1);
  ImGui::GetWindowDrawList()->AddLine({window.Pos.x + px(8), y},
                                      {window.Pos.x + window.Size.x - px(8), y},
                                      faded(theme_colors().edge));
  ImGui::Dummy({0, px(3)});
}

DialogKey dialog_key() {
  bool& covered = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("covered"));
  const bool was = std::exchange(covered, ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId));
  if (was) return DialogKey::none;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) return DialogKey::escape;
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const bool is_taken = context.ActiveIdPreviousFrame != 0 || !context.NavDisableHighlight;
  return !is_taken && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)
             ? DialogKey::enter
             : DialogKey::none;
}

}  // namespace holomorph
