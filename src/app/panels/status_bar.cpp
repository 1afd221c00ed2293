// The left part says what to do or what is wrong. The right part shows figures and is never cut
// off.
#include <algorithm>
#include <cstdio>

#include "app/panels/panels.h"
#include "scene/report.h"

namespace holomorph {
namespace {

/// A green that is readable on the bar of every theme.
ImVec4 proved_color() {
  const ImVec4 bar = ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg);
  return bar.x > 0.5f ? ImVec4(0.05f, 0.45f, 0.15f, 1) : ImVec4(0.45f, 0.85f, 0.5f, 1);
}

}  // namespace

void draw_status_bar(Workspace& workspace, const StatusLine& status, double scale) {
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float s = static_cast<float>(scale), height = static_cast<float>(sizes.status);
  ImGui::SetNextWindowPos({0, display.y - height});
  ImGui::SetNextWindowSize({display.x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12 * s, 4 * s});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  ImGui::Begin("Status", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar);
  ImGui::AlignTextToFramePadding();
  const LiveMap& map = workspace.map();
  std::string hint, note;
  ImVec4 note_color;
  if (map.error()) {
    ImGui::TextColored({1.0f, 0.45f, 0.4f, 1}, "\uf071 %s", map.error()->what());
    if (const auto where = map.error()->where()) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) workspace.display.viewport.center = *where;
    }
    const Deformation& deformation = workspace.shown.deformation();
    if (!deformation.rest.holes.empty() && !method_named(deformation.method).allows_holes) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Fill holes")) run("cage.fill", workspace);
    }
  } else {
    hint = status.hint;
    const auto state = map.map().status;
    if (map.has_map() && state == SampledMap::Status::certified) {
      note = "\uf00c " + map.map().note;
      note_color = proved_color();
    } else if (map.has_map() && state == SampledMap::Status::infeasible) {
      note = "\uf071 " + map.map().note;
      note_color = {1.0f, 0.45f, 0.4f, 1};
    } else if (!map.injectivity().folds_at.empty()) {
      ImGui::TextColored({1.0f, 0.45f, 0.4f, 1}, "\uf071 The picture folds over itself");
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) run("view.fold", workspace);
      ImGui::SameLine();
    }
  }
  char right[240] = "";
  int used = 0;
  const auto add = [&](const char* format, auto... values) {
    used +=
        std::snprintf(right + used, sizeof right - static_cast<size_t>(used), format, values...);
    used = std::min(used, static_cast<int>(sizeof right) - 1);
  };
  const DragOptions& drag_options = workspace.tools.drag;
  if (drag_options.soft) add("Soft %.0f px   ", drag_options.reach);
  if (drag_options.symmetric) add("%s   ", "Symmetry");
  if (workspace.tools.snaps) add("%s   ", "Snap");
  if (status.cursor) add("%.0f, %.0f px   ", status.cursor->real(), status.cursor->imag());
  if (status.cursor_at_rest)
    add("from %.0f, %.0f px   ", status.cursor_at_rest->real(), status.cursor_at_rest->imag());
  if (!workspace.document.empty()) add("%.0f %%   ", 100 * workspace.display.viewport.zoom);
  if (map.has_map()) {
    add("%s: ", method_named(workspace.shown.deformation().method).label.c_str());
    const bool closed_form = map.map().status == SampledMap::Status::exact;
    add("%s%.1f ms%s   ",
        closed_form ? "" : (std::string(name_of(map.map().status)) + ", ").c_str(),
        map.pose_milliseconds(), status.by_operator ? " (GPU)" : "");
  }
  if (!workspace.document.empty()) add("%s", status.draft ? "draft" : "final");
  const float width = ImGui::CalcTextSize(right).x;
  // The left part is cut off before it reaches the figures.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(at, {display.x - width - 30 * s, display.y}, true);
  if (!note.empty()) {
    const float left = display.x - width - 30 * s - ImGui::GetCursorScreenPos().x;
    ImGui::TextColored(note_color, "%s", fitted_text(note, left).c_str());
    ImGui::SameLine();
  }
  const float room = display.x - width - 30 * s - ImGui::GetCursorScreenPos().x;
  ImGui::TextUnformatted(fitted_text(hint, room).c_str());
  ImGui::PopClipRect();
  ImGui::SameLine(display.x - width - 14 * s);
  ImGui::TextDisabled("%s", right);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace holomorph
