// The panel on the right: the selection, the layers and the method, then what is needed less often.
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/panels/film_panel.h"
#include "app/panels/layer_panel.h"
#include "app/panels/map_panel.h"
#include "app/panels/method_panel.h"
#include "app/panels/panels.h"
#include "app/panels/selection_panel.h"

namespace holomorph {
namespace {

constexpr const char* kViews[] = {"view.image", "view.angle", "view.area", "view.stretch",
                                  "view.checker"};

const Action& view_action(const Workspace& workspace) {
  return workspace.actions.named(kViews[static_cast<int>(workspace.display.view)]);
}

void background_rows(Workspace& workspace) {
  static constexpr const char* kIds[] = {"background.transparent", "background.color",
                                         "background.original"};
  static constexpr const char* kNames[] = {"Transparent", "Color", "The original"};
  Scene scene = workspace.document.scene();
  row_label("Background",
            "What is shown and exported where the picture is transparent or has moved away");
  if (begin_dropdown("##Background", kNames[static_cast<int>(scene.background.fill)])) {
    for (int i = 0; i < 3; ++i)
      if (const Action& action = workspace.actions.named(kIds[i]);
          dropdown_row(kNames[i], action.checked(workspace)))
        run(action, workspace);
    end_dropdown();
  }
  if (scene.background.fill != Background::Fill::color) return;
  row_label("Color");
  if (color_field("##Color", scene.background.color, ImGui::GetContentRegionAvail().x))
    workspace.commit_or_amend_layers("Background color", scene);
}

void view_section(Workspace& workspace, const HeatScale& heat) {
  row_label("Color by");
  if (begin_dropdown("##View", view_action(workspace).label)) {
    for (const char* id : kViews) {
      const Action& action = workspace.actions.named(id);
      if (dropdown_row(action.label, action.checked(workspace), action.enabled(workspace)))
        run(action, workspace);
    }
    end_dropdown();
  }
  if (is_heat(workspace.display.view)) {
    bool& fits = workspace.display.automatic_range;
    if (switch_row("Fit range", fits, "Fit the color range to the map")) fits = !fits;
    char text[64];
    std::snprintf(text, sizeof text, "Colors: %.3g to %.3g", heat.low, heat.high);
    caption(text);
  }
  bool& mesh = workspace.display.show_mesh;
  if (switch_row("Mesh", mesh)) mesh = !mesh;
  background_rows(workspace);
}

void history_section(Workspace& workspace) {
  const History& history = workspace.document.history();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(10)});
  begin_part("history", {0, std::max(ImGui::GetContentRegionAvail().y,
                                     7 * ImGui::GetTextLineHeightWithSpacing())});
  // Scroll only when the current step has changed, so that the user can scroll freely otherwise.
  int& shown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);
  const bool moved =
      std::exchange(shown, static_cast<int>(history.index())) != static_cast<int>(history.index());
  for (size_t i = history.entries().size(); i-- > 0;) {
    const bool current = i == history.index();
    if (i > history.index())
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const bool go = text_row(static_cast<int>(i), history.entries()[i].label, current);
    if (current && moved) ImGui::SetScrollHereY();
    if (i > history.index()) ImGui::PopStyleColor();
    if (go) {
      workspace.go_to(i);
      break;
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

}  // namespace

PanelAnswer draw_inspector(Workspace& workspace, const InspectorParts& parts,
                           const PanelSizes& sizes) {
  const ThemeColors& c = theme_colors();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float left = display.x - static_cast<float>(sizes.inspector),
              top = static_cast<float>(sizes.menu),
              bottom = display.y - static_cast<float>(sizes.status);
  PanelAnswer answer;
  begin_panel("Inspector", {left, top}, {display.x, bottom}, c.panel, {16, 0});
  ImGui::GetWindowDrawList()->AddLine({left, top}, {left, bottom}, faded(c.line));
  // Draws a section. `id` is where its state is kept; `has_to` opens it in any case.
  const auto section = [&](const std::string& id, const std::string& title, const StateText& state,
                           bool opens, auto draw, bool has_to = false) {
    bool& open = parts.preferences.sections.try_emplace(id, opens).first->second;
    const bool was = open;
    if (has_to) open = true;
    const bool shows =
        begin_section(title + "###" + id, state.text, state.color ? state.color : c.muted, open);
    if (open != was && !has_to) answer.preferences_changed = true;
    if (!shows) {
      ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y);
      return;
    }
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(4));
    ImGui::PushID(id.c_str());
    draw();
    ImGui::PopID();
    ImGui::Dummy({0, px(4)});
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y);
  };
  const Scene& scene = workspace.document.scene();
  if (parts.start_card)
    parts.start_card->draw_docked(workspace, parts.style);
  else
    section("selection", selection_title(workspace), {title_of_layer(scene, scene.edited)}, true,
            [&] { selection_section(workspace); });
  section(
      "layers", "Layers", {}, true, [&] { parts.layers.draw(workspace, parts.thumbnails); },
      parts.layers.is_renaming());
  if (has_film(workspace)) section("film", "Film", {}, true, [&] { film_section(workspace); });
  section("method", "Method", {}, true, [&] {
    const PanelAnswer method = method_section(workspace, parts.preferences);
    answer.preferences_changed = answer.preferences_changed || method.preferences_changed;
    convergence_section(workspace);
  });
  section("folds", "Folds", fold_state(workspace), false, [&] { injectivity_section(workspace); });
  section("view", "View", {view_action(workspace).label}, false,
          [&] { view_section(workspace, parts.heat); });
  section("history", "History", {}, false, [&] { history_section(workspace); });
  const ImVec2 end = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({left, end.y}, {display.x, end.y}, faded(c.line));
  end_panel();
  return answer;
}

}  // namespace holomorph
