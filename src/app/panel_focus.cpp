// ImGui goes through a window's items itself; it has to be told where to begin.
#include "app/panel_focus.h"

#include <imgui.h>
// After imgui.h. Focusing an item that nobody has pointed at is not in the public part.
#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace holomorph {
namespace {

/// In the order in which they are gone through.
constexpr const char* kPanels[] = {"Welcome",   "Cage offer",  "Missing picture",
                                   "Inspector", "Timeline",    "Surface",
                                   "Toolbar",   "First steps", "Projections onto the same bounds"};

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

void PanelFocus::leave() {
  if (!panel_) return;
  panel_ = nullptr;
  ImGui::FocusWindow(nullptr);
}

void PanelFocus::look() {
  if (!panel_) return;
  if (!shown(panel_)) return leave();
  const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow;
  if (!window) return;
  const auto* now = std::ranges::find(kPanels, std::string_view(window->RootWindow->Name),
                                      [](const char* name) { return std::string_view(name); });
  if (now != std::end(kPanels)) panel_ = *now;
}

}  // namespace holomorph
