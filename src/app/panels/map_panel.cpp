// Colored marks come with words, because not everyone can tell colors apart.
#include "app/panels/map_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

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

/// Plots the energy against the iteration, counted from 1, on logarithmic axes.
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
  tooltip(
      "Details: the energy after each iteration, on logarithmic axes. "
      "The unit of length is the cage's perimeter divided by 2 pi.");
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
  ImGui::Text("Iteration %d of %d", shown, last);
  ImGui::TextDisabled("Details: energy %.3g", map.energies[static_cast<size_t>(shown)]);
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
  const int extra_turns = static_cast<int>(std::lround(turns)) - 1;
  if (!found.folds()) {
    ImGui::Text("\uf00c No folds");
  } else {
    ImGui::TextColored(warning, turns < 0 ? "\uf071 Flipped over" : "\uf071 Folds");
    if (!found.folds_at.empty()) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Show me")) run("view.fold", workspace);
      tooltip_of(workspace.actions.named("view.fold"));
      if (found.folds_at.size() > 1)
        ImGui::TextColored(warning, "in %d places", static_cast<int>(found.folds_at.size()));
    }
  }
  ImGui::TextDisabled("Details: turning number %.0f", turns);
  tooltip(
      "How many times the edge of the picture turns: 1 unless the picture "
      "overlaps itself at a point or is flipped over.");
  if (extra_turns > 0)
    ImGui::TextColored(warning, "Overlaps itself at %d point%s", extra_turns,
                       extra_turns == 1 ? "" : "s");
  if (const auto& proved = workspace.map().map().extremes) {
    ImGui::TextDisabled("Details: sizes %.0f to %.0f %%, shear %.0f %%", 100 * proved->smallest,
                        100 * proved->largest, 100 * proved->shear);
    tooltip(
        "Proved limits: no length in the picture shrinks or grows more than this, in any "
        "direction. Shear is 0 % where angles are kept, and 100 % where the picture is flat.");
  } else {
    ImGui::TextDisabled("Details: smallest size %.0f %%",
                        std::round(100 * found.least_stretch) + 0.0);  // no "-0"
    tooltip(
        "The size that remains where the picture is compressed most, in the "
        "direction of the strongest compression. Below 0 %, it is flipped over.");
  }
  if (found.crossing) {
    ImGui::TextDisabled("Parts overlap");
    show(*found.crossing, "The edge of the picture crosses itself here.");
  }
  if (const Points& marked = workspace.map().map().zeros; !marked.empty())
    ImGui::TextDisabled("Would fold at %d %s (diamonds)", static_cast<int>(marked.size()),
                        marked.size() == 1 ? "point" : "points");
  const Action& fold_free = workspace.actions.named("map.fold_free");
  if (found.folds() && fold_free.enabled(workspace))
    action_button("map.fold_free", fold_free.label.c_str(), workspace);
}

}  // namespace holomorph
