// Colored marks come with words, because not everyone can tell colors apart.
#include "app/panels/map_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"

namespace holomorph {
namespace {

/// Plots the energy against the iteration, counted from 1, on logarithmic axes.
void plot(const std::vector<double>& energies, int shown) {
  const float height = px(84);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, faded(theme_colors().field), px(4));
  const auto [least, most] = std::ranges::minmax(energies);
  const double floor = std::max(1e-12 * most, 1e-300), low = std::log(std::max(least, floor)),
               span = std::max(std::log(std::max(most, floor)) - low, 1e-9),
               last = std::log(static_cast<double>(energies.size()));
  const float margin = px(8);
  const auto place = [&](size_t i) {
    const double x = std::log(static_cast<double>(i) + 1) / std::max(last, 1e-9),
                 y = (std::log(std::max(energies[i], floor)) - low) / span;
    return ImVec2(at.x + margin + static_cast<float>(x) * (width - 2 * margin),
                  at.y + height - margin - static_cast<float>(y) * (height - 2 * margin));
  };
  std::vector<ImVec2> line;
  for (size_t i = 0; i < energies.size(); ++i) line.push_back(place(i));
  list.AddPolyline(line.data(), static_cast<int>(line.size()),
                   ImGui::GetColorU32(ImGuiCol_PlotLines), 0, px(2));
  list.AddCircleFilled(line[static_cast<size_t>(shown)], px(4),
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  ImGui::Dummy({width, height});
  tooltip(
      "Details: the energy after each iteration, on logarithmic axes. "
      "The unit of length is the cage's perimeter divided by 2 pi.");
}

/// A muted line for those who know the mathematics.
void details(const std::string& text, const char* tip) {
  const ScopedFont small(Type::caption);
  muted_text(text);
  tooltip(tip);
}

/// Whether triangles are inverted in a map that does not fold.
bool has_coarse_mesh(const Workspace& workspace) {
  return workspace.map().map().coarse_triangles > 0;
}

std::string percent(double value) {
  return std::to_string(std::lround(100 * value)) + " %";
}

}  // namespace

void convergence_section(Workspace& workspace) {
  const SampledMap& map = workspace.map().map();
  if (map.energies.size() < 2) return;
  const int last = static_cast<int>(map.energies.size()) - 1,
            shown = std::min(map.iterations, last);
  plot(map.energies, shown);
  const auto control = [&](const char* id, const char* icon) {
    const Action& action = workspace.actions.named(id);
    ImGui::BeginDisabled(!action.enabled(workspace));
    if (icon_button(id, icon, "")) run(action, workspace);
    tooltip_of(action);
    ImGui::EndDisabled();
    ImGui::SameLine(0, px(4));
  };
  control("map.play", workspace.playback.playing ? icon_named("pause") : icon_named("play"));
  control("map.step", icon_named("next"));
  control("map.restart", icon_named("to-start"));
  ImGui::AlignTextToFramePadding();
  char text[80];
  std::snprintf(text, sizeof text, "Iteration %d of %d, energy %.3g", shown, last,
                map.energies[static_cast<size_t>(shown)]);
  caption(text);
}

StateText fold_state(const Workspace& workspace) {
  const ThemeColors& c = theme_colors();
  if (!workspace.map().has_map()) return {};
  if (const size_t count = workspace.folds().size(); count > 0) {
    if (has_coarse_mesh(workspace)) return {"Mesh too coarse", c.warning};
    const bool flipped = workspace.map().injectivity().turning_number < 0;
    return {flipped     ? "Flipped over"
            : count > 1 ? std::to_string(count) + " folds"
                        : "Folds",
            c.error};
  }
  return {"No folds", c.success};
}

void injectivity_section(Workspace& workspace) {
  const ThemeColors& c = theme_colors();
  if (!workspace.map().has_map()) return muted_text("There is no map yet.");
  const Injectivity& found = workspace.map().injectivity();
  const StateText state = fold_state(workspace);
  const auto show_me = [&](const char* label) {
    ImGui::SameLine();
    if (small_button(label)) run("view.fold", workspace);
    tooltip_of(workspace.actions.named("view.fold"));
  };
  const bool folds = !workspace.folds().empty();
  if (folds) ImGui::AlignTextToFramePadding();
  colored_text(state.color,
               std::string(folds ? icon_named("warning") : icon_named("check")) + " " + state.text);
  if (folds) show_me("Show me");
  if (!folds && workspace.overlap()) {
    ImGui::AlignTextToFramePadding();
    colored_text(c.warning, "Parts overlap");
    show_me("Show me##overlap");
  }
  const bool is_coarse = folds && has_coarse_mesh(workspace);
  const int extra_turns = static_cast<int>(std::lround(found.turning_number)) - 1;
  if (is_coarse)
    muted_text("The map does not fold; its mesh is too coarse.");
  else if (folds && extra_turns > 0)
    colored_text(c.warning, "Overlaps itself at " + std::to_string(extra_turns) +
                                (extra_turns == 1 ? " point" : " points"));
  if (const Points& marked = workspace.map().map().zeros; !marked.empty())
    caption("Would fold at " + std::to_string(marked.size()) +
            (marked.size() == 1 ? " point (diamond)" : " points (diamonds)"));
  const Action& prevents = workspace.actions.named("map.fold_free");
  if (folds && prevents.enabled(workspace) && !prevents.checked(workspace) &&
      small_button(prevents.label))
    run(prevents, workspace);
  if (const auto& proved = workspace.map().map().extremes) {
    details("Details: sizes " + percent(proved->smallest) + " to " + percent(proved->largest) +
                ", shear " + percent(proved->shear),
            "Proved limits of the smooth map: no length in the picture shrinks or grows more than "
            "this, in any direction. The small triangles that draw it may exceed them where it "
            "bends sharply. Shear is 0 % where angles are kept, and 100 % where the picture is "
            "flat.");
  } else {
    details("Details: smallest size " + percent(found.least_stretch + 0.0) +
                (!folds && found.least_stretch < 0 ? ", where it cannot be seen" : ""),
            "The size that remains where the picture is compressed most, in the "
            "direction of the strongest compression. Below 0 %, it is flipped over.");
  }
  if (is_coarse) return;
  details("Turning number " + std::to_string(std::lround(found.turning_number)),
          "How many times the edge of the picture turns: 1 unless the picture "
          "overlaps itself at a point or is flipped over.");
}

}  // namespace holomorph
