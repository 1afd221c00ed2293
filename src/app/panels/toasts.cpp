// Each message is shown in its own small window, as wide as its text. The windows are stacked.
#include "app/panels/toasts.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <utility>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

constexpr double kShownMs = 4500, kProblemMs = 9000, kLeavesMs = 150, kReadingMs = 20;
constexpr double kWidest = 480;

}  // namespace

void Toasts::draw(Workspace& workspace, const OverlayStyle& style, double now_ms) {
  const size_t step = workspace.document.history().index();
  // Remove messages about a point after the next history step, because the point may have changed.
  std::erase_if(shown_,
                [&](const Shown& shown) { return shown.toast.where && shown.step != step; });
  for (Toast& toast : std::exchange(workspace.messages.toasts, {})) {
    // A repeated message is shown longer instead of twice.
    std::erase_if(shown_, [&](const Shown& shown) { return shown.toast.text == toast.text; });
    const double until = now_ms + (toast.problem ? kProblemMs : kShownMs) +
                         kReadingMs * static_cast<double>(toast.text.size());
    shown_.push_back({std::move(toast), until, step});
  }
  const ThemeColors& c = theme_colors();
  const Viewport& view = workspace.display.viewport;
  const float margin = px(16), left = static_cast<float>(view.left) + margin,
              widest = std::min(px(kWidest), static_cast<float>(view.width) - 2 * margin);
  // The latest message is the lowest.
  float y = static_cast<float>(view.top + view.height) - margin;
  for (size_t i = shown_.size(); i-- > 0;) {
    const Toast& toast = shown_[i].toast;
    const float remaining = static_cast<float>((shown_[i].until - now_ms) / kLeavesMs);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(14), px(10)});
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::clamp(remaining, 0.2f, 1.0f));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(c.raised));
    begin_floating(("toast " + toast.text).c_str(), {left, y}, {0, 1},
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoFocusOnAppearing |
                       ImGuiWindowFlags_NoNav | (toast.where ? 0 : ImGuiWindowFlags_NoInputs));
    if (toast.problem) {
      colored_text(c.error, icon_named("warning"));
      ImGui::SameLine(0, px(8));
    }
    const float wrap = std::min(widest - px(40), text_size(Type::body, toast.text).x + 1);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::TextUnformatted(toast.text.c_str());
    ImGui::PopTextWrapPos();
    if (toast.where) {
      ImGui::SameLine(0, px(12));
      ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(4));
      if (small_button("Show me", ButtonKind::flat)) workspace.center_on(*toast.where);
      draw_marker(workspace, *toast.where, style);
    }
    y -= ImGui::GetWindowHeight() + px(8);
    end_card();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
  }
}

bool Toasts::expire(double now_ms) {
  return std::erase_if(shown_, [&](const Shown& shown) { return shown.until < now_ms; }) > 0;
}

}  // namespace holomorph
