// Each message is shown in its own small window. The windows are stacked.
#include "app/panels/toasts.h"

#include <utility>

#include "core/clock.h"

namespace holomorph {
namespace {

constexpr double kShownMs = 4500, kProblemMs = 9000;

}  // namespace

void Toasts::draw(Workspace& workspace, const OverlayStyle& style) {
  const size_t step = workspace.document.history().index();
  // Remove messages about a point after the next history step, because the point may have changed.
  std::erase_if(shown_,
                [&](const Shown& shown) { return shown.toast.where && shown.step != step; });
  for (Toast& toast : std::exchange(workspace.messages.toasts, {})) {
    // A repeated message is shown longer instead of twice.
    std::erase_if(shown_, [&](const Shown& shown) { return shown.toast.text == toast.text; });
    const double until = now_ms() + (toast.problem ? kProblemMs : kShownMs);
    shown_.push_back({std::move(toast), until, step});
  }
  const float s = static_cast<float>(style.scale);
  const Viewport& view = workspace.display.viewport;
  const float wrap = static_cast<float>(std::min(620.0 * s, view.width - 40 * s));
  // Messages are stacked downward from the menu. On the welcome page, whose title is at the top,
  // they are stacked upward from the status bar.
  const bool upwards = workspace.document.empty();
  float y = static_cast<float>(upwards ? view.top + view.height - 6 * style.scale
                                       : view.top + 6 * style.scale);
  for (size_t i = 0; i < shown_.size(); ++i) {
    const Toast& toast = shown_[i].toast;
    ImGui::SetNextWindowPos({static_cast<float>(view.left + view.width / 2), y}, ImGuiCond_Always,
                            {0.5f, upwards ? 1.0f : 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14 * s, 8 * s});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6 * s);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.5f * s);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, style.colors.panel);
    ImGui::PushStyleColor(ImGuiCol_Border,
                          toast.problem ? style.colors.warning : style.colors.accent);
    ImGui::Begin(("toast" + std::to_string(i)).c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     (toast.where ? 0 : ImGuiWindowFlags_NoInputs));
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::TextUnformatted((toast.problem ? "\uf071  " + toast.text : toast.text).c_str());
    ImGui::PopTextWrapPos();
    if (toast.where) {
      if (ImGui::SmallButton("Show me")) workspace.display.viewport.center = *toast.where;
      draw_marker(workspace, *toast.where, style);
    }
    y += (upwards ? -1 : 1) * (ImGui::GetWindowHeight() + 8 * s);
    ImGui::End();
    ImGui::PopStyleColor(2);
    ImGui::PopStyleVar(3);
  }
}

bool Toasts::expire() {
  return std::erase_if(shown_, [](const Shown& shown) { return shown.until < now_ms(); }) > 0;
}

}  // namespace holomorph
