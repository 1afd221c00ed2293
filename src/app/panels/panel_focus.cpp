// Within a window, ImGui itself moves the focus between items, but it must be told where to begin.
#include "app/panels/panel_focus.h"

#include <imgui.h>
// Needed because the functions of imgui.h cannot focus an item that is not under the pointer.
#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace holomorph {
namespace {

/// Names of windows, in the order in which F6 visits them.
constexpr const char* kPanels[] = {"Welcome",     "Start",          "Missing picture", "Inspector",
                                   "Timeline",    "Surface",        "Options",         "Toolbar",
                                   "First steps", "Compare methods"};
constexpr const char* kMenuBar = "##MainMenuBar";  // ImGui's name

ImGuiWindow* shown(const char* name) {
  ImGuiWindow* window = ImGui::FindWindowByName(name);
  return window && window->WasActive ? window : nullptr;
}

}  // namespace

void PanelFocus::next() {
  const auto* panel = std::ranges::find(kPanels, panel_);
  panel = panel == std::end(kPanels) ? std::begin(kPanels) : std::next(panel);
  panel = std::find_if(panel, std::end(kPanels), shown);
  if (panel == std::end(kPanels)) return leave();
  panel_ = *panel;
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  ImGui::FocusWindow(shown(panel_));
  ImGui::NavInitWindow(shown(panel_), false);
  imgui.NavDisableHighlight = false;
  imgui.NavDisableMouseHover = true;
}

void PanelFocus::go_to_menu(const char* name) {
  panel_ = kMenuBar;
  ImGuiWindow& bar = *ImGui::GetCurrentWindow();
  const ImVec2 at = bar.DC.CursorPos - bar.Pos;
  ImGui::FocusWindow(&bar);
  ImGui::SetNavID(bar.GetID(name), ImGuiNavLayer_Menu, 0, {at, at + ImGui::CalcTextSize(name)});
  ImGui::GetCurrentContext()->NavDisableHighlight = false;
}

void PanelFocus::leave() {
  if (!panel_) return;
  panel_ = nullptr;
  chooses_ = false;
  ImGui::FocusWindow(nullptr);
}

void PanelFocus::look() {
  if (!panel_) return;
  if (!shown(panel_)) return leave();
  if (panel_ == kMenuBar) {
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    const bool open =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    if (!open && chooses_) return leave();
    chooses_ = open && (chooses_ || pressed(ImGuiKey_Enter) || pressed(ImGuiKey_Space));
    return;
  }
  const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow;
  if (!window) return;
  const auto* now = std::ranges::find(kPanels, std::string_view(window->RootWindow->Name),
                                      [](const char* name) { return std::string_view(name); });
  if (now != std::end(kPanels)) panel_ = *now;
}

}  // namespace holomorph
