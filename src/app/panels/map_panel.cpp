// Marks come with words: no colour says anything alone.
#include "app/panels/map_panel.h"

#include <imgui.h>

#include <algorithm>

#include "app/panels/panels.h"

namespace holomorph {
namespace {

void action_button(const char* id, const char* text, Workspace& workspace) {
  const Action& action = workspace.actions.named(id);
  ImGui::BeginDisabled(!action.enabled(workspace));
  if (ImGui::Button(text)) run(action, workspace);
  ImGui::EndDisabled();
  tooltip_of(action);
}

/// A polyline of log energy over log of the iteration (the first one counts as 1).
void plot(const std::vector<double>& energies, int shown, double scale) {
  const float s = static_cast<float>(scale), height = 84 * s;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                     4 * s);
  const auto [least, most] = std::ranges::minmax(energies);
  const double floor = std::max(1e-12 * most, 1e-300), low = std::log(std::max(least, floor)),
               span = std::max(std::log(std::max(most, floor)) - low, 1e-9),
               last = std::log(static_cast<double>(energies.size()));
  const float margin = 8 * s;
  const auto place = [&](size_t i) {
    const double x = std::log(static_cast<double>(i) + 1) / std::max(last, 1e-9),
                 y = (std::log(std::max(energies[i], floor)) - low) / span;
    return ImVec2(at.x + margin + static_cast<float>(x) * (width - 2 * margin),
                  at.y + height - margin - static_cast<float>(y) * (height - 2 * margin));
  };
  std::vector<ImVec2> line;
  for (size_t i = 0; i < energies.size(); ++i) line.push_back(place(i));
  list.AddPolyline(line.data(), static_cast<int>(line.size()),
                   ImGui::GetColorU32(ImGuiCol_PlotLines), 0, 1.8f * s);
  list.AddCircleFilled(line[static_cast<size_t>(shown)], 4 * s,
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  ImGui::Dummy({width, height});
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "The energy after each iteration, both on logarithmic scales.\n"
        "Lengths are in units of the cage's perimeter / 2 pi.");
}

}  // namespace

void convergence_section(Workspace& workspace, double scale) {
  const SampledMap& map = workspace.map().map();
  if (map.energies.size() < 2) return;
  const int last = static_cast<int>(map.energies.size()) - 1,
            shown = std::min(map.iterations, last);
  plot(map.energies, shown, scale);
  action_button("map.play", workspace.playback.playing ? "\uf04c" : "\uf04b", workspace);
  ImGui::SameLine();
  action_button("map.step", "\uf051", workspace);
  ImGui::SameLine();
  action_button("map.restart", "\uf049", workspace);
  ImGui::SameLine();
  ImGui::Text("Step %d of %d", shown, last);
  ImGui::TextDisabled("energy %.3g", map.energies[static_cast<size_t>(shown)]);
}

void injectivity_section(Workspace& workspace, Theme theme) {
  if (!workspace.map().has_map()) return;
  const Injectivity& found = workspace.map().injectivity();
  const ImVec4 warning = ImGui::ColorConvertU32ToFloat4(canvas_colors(theme).warning);
  const auto show = [&](Complex where, const char* text) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetItemRectMax().x + style.ItemSpacing.x +
                      ImGui::CalcTextSize("Show me").x + 2 * style.FramePadding.x;
    if (end < ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x) ImGui::SameLine();
    ImGui::PushID(text);
    if (ImGui::SmallButton("Show me")) {
      workspace.mode = EditMode::pose;
      workspace.display.viewport.center = where;
      workspace.messages.toasts.push_back({text, true, where});
    }
    ImGui::PopID();
  };
  const double turns = found.turning_number;
  const int winds = static_cast<int>(std::lround(turns)) - 1;
  if (!found.folds()) {
    ImGui::Text("\uf00c Nothing folds");
  } else {
    ImGui::TextColored(warning, turns < 0 ? "\uf071 Lies on its back" : "\uf071 Folds");
    if (!found.folds_at.empty()) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) run("view.fold", workspace);
      tooltip_of(workspace.actions.named("view.fold"));
      if (found.folds_at.size() > 1)
        ImGui::TextColored(warning, "in %d places", static_cast<int>(found.folds_at.size()));
    }
  }
  ImGui::TextDisabled("Boundary turns %.2f times", turns);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "The turning number of the picture's boundary: 1 unless the picture\n"
        "winds around a branch point or lies on its back.");
  if (winds > 0)
    ImGui::TextColored(warning, "It winds around %d branch point%s", winds, winds == 1 ? "" : "s");
  ImGui::TextDisabled("Least stretch %.3g", found.least_stretch);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "min |f_z| - |f_zbar|: the length that is left of a unit of the picture,\n"
        "where and in the direction in which it shrinks most; below 0 it is turned over.");
  if (found.crossing) {
    ImGui::TextDisabled("Parts lie over each other");
    show(*found.crossing, "The picture's boundary crosses itself here.");
  }
  if (const Points& marked = workspace.map().map().zeros; !marked.empty())
    ImGui::TextDisabled("%d %s where it would fold (diamonds)", static_cast<int>(marked.size()),
                        marked.size() == 1 ? "place" : "places");
  const Action& fold_free = workspace.actions.named("map.fold_free");
  if (found.folds() && fold_free.enabled(workspace))
    action_button("map.fold_free", fold_free.label.c_str(), workspace);
}

}  // namespace holomorph
