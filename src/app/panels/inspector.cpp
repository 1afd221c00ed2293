// The panel on the right: layers, method, folds, selection, cage, view and history.
#include <utility>

#include "app/panels/layer_panel.h"
#include "app/panels/map_panel.h"
#include "app/panels/panels.h"
#include "app/panels/selection_panel.h"
#include "scene/auto_cage.h"

namespace holomorph {
namespace {

void choice_combo(Workspace& workspace, const Deformation& deformation, const ParameterSpec& spec,
                  size_t chosen) {
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.72f);
  if (!begin_combo(spec.label.c_str(), spec.options[chosen].label.c_str())) return;
  for (size_t i = 0; i < spec.options.size(); ++i)
    if (ImGui::Selectable(spec.options[i].label.c_str(), i == chosen)) {
      Deformation after = deformation;
      after.parameters[spec.key] = static_cast<double>(i);
      workspace.commit(spec.label + ": " + spec.options[i].label, after);
    }
  ImGui::EndCombo();
}

bool number_slider(const ParameterSpec& spec, double& value) {
  // A logarithmic slider cannot reach values that are too small for its format.
  const char* format = spec.logarithmic ? "%.9g" : "%.4g";
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (!ImGui::SliderScalar(
          spec.label.c_str(), ImGuiDataType_Double, &value, &spec.lowest, &spec.highest, format,
          ImGuiSliderFlags_AlwaysClamp | (spec.logarithmic ? ImGuiSliderFlags_Logarithmic : 0)))
    return false;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  value = std::clamp(std::strtod(text, nullptr), spec.lowest, spec.highest);
  return true;
}

/// Draws a button for each preset. The preset in use looks pressed.
void preset_buttons(Workspace& workspace, const Deformation& deformation, const Method& method) {
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  for (const Preset& preset : method.presets) {
    const Deformation after = with_preset(deformation, preset);
    const float width =
        ImGui::CalcTextSize(preset.label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (&preset != &method.presets.front()) {
      ImGui::SameLine(0, 4);
      if (ImGui::GetCursorScreenPos().x + width > right) ImGui::NewLine();
    }
    const bool is_set = after.parameters == deformation.parameters;
    if (is_set)
      ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(preset.label.c_str())) workspace.commit(preset.label, after);
    if (is_set) ImGui::PopStyleColor();
  }
}

void method_section(Workspace& workspace) {
  const Deformation deformation =
      workspace.shown.deformation();  // a copy, because a commit replaces the original
  const Method& method = method_named(deformation.method);
  ImGui::SetNextItemWidth(-1);
  if (begin_combo("##method", method.label.c_str())) {
    for (const Method& row : methods()) {
      if (ImGui::Selectable(row.label.c_str(), row.id == method.id))
        workspace.commit("Method: " + row.label, with_method(deformation, row.id));
      tooltip(row.hint);
    }
    ImGui::EndCombo();
  }
  tooltip(method.hint);
  preset_buttons(workspace, deformation, method);
  for (const ParameterSpec& spec : method.parameters) {
    const double value = parameter(method, deformation.parameters, spec.key);
    if (spec.type == ParameterSpec::Type::choice) {
      choice_combo(workspace, deformation, spec, static_cast<size_t>(value));
    } else if (spec.type == ParameterSpec::Type::toggle) {
      bool on = value != 0;
      if (ImGui::Checkbox(spec.label.c_str(), &on)) {
        Deformation after = deformation;
        after.parameters[spec.key] = on ? 1 : 0;
        workspace.commit(spec.label, after);
      }
    } else {
      ImGui::BeginDisabled(!is_used(method, deformation.parameters, spec));
      double number = value;
      if (number_slider(spec, number)) {
        Deformation after = workspace.shown.base();
        after.parameters[spec.key] = number;
        workspace.shown.preview = after;
      }
      if (ImGui::IsItemDeactivatedAfterEdit() && workspace.shown.preview)
        workspace.commit(spec.label, *workspace.shown.preview);
      ImGui::EndDisabled();
    }
    tooltip(spec.hint);
  }
  if (workspace.map().has_map() && !workspace.map().map().note.empty())
    wrapped_text(workspace.map().map().note);
}

/// Text such as "2 pins", with a note if the method does not use them.
std::string counted(size_t count, const std::string& what, bool used) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s") +
         (count == 0 || used ? "" : " (unused)");
}

void cage_section(Workspace& workspace) {
  const Deformation& deformation = workspace.shown.deformation();
  if (deformation.has_cage())
    ImGui::Text(
        "%d cage points%s, %s, %s", static_cast<int>(deformation.rest.size()),
        deformation.rest.holes.empty()
            ? ""
            : (", " + counted(deformation.rest.holes.size(), "hole", true)).c_str(),
        counted(deformation.pins.size(), "pin", method_named(deformation.method).uses_pins).c_str(),
        counted(deformation.strokes.size(), "stroke", method_named(deformation.method).uses_strokes)
            .c_str());
  else
    ImGui::TextDisabled("No cage yet.");
  detail_slider(workspace, ImGui::GetContentRegionAvail().x * 0.55f);
  hole_slider(workspace, ImGui::GetContentRegionAvail().x * 0.55f);
  ImGui::Checkbox("Curved", &workspace.tools.auto_cage.curved);
  const Action& action = workspace.actions.named("cage.from_picture");
  ImGui::BeginDisabled(!action.enabled(workspace));
  if (ImGui::Button("Make from picture")) run(action, workspace);
  ImGui::EndDisabled();
  tooltip("Replaces the cage with one around the largest opaque part of the picture");
}

void heat_section(Workspace& workspace, const HeatScale& heat) {
  static constexpr const char* kIds[] = {"view.image", "view.angle", "view.area", "view.stretch",
                                         "view.checker"};
  ImGui::SetNextItemWidth(-1);
  if (begin_combo(
          "##view",
          workspace.actions.named(kIds[static_cast<int>(workspace.display.view)]).label.c_str())) {
    for (const char* id : kIds) {
      const Action& action = workspace.actions.named(id);
      ImGui::BeginDisabled(!action.enabled(workspace));
      if (ImGui::Selectable(action.label.c_str(), action.checked(workspace)))
        run(action, workspace);
      ImGui::EndDisabled();
    }
    ImGui::EndCombo();
  }
  if (is_heat(workspace.display.view)) {
    ImGui::Checkbox("Fit color range to map", &workspace.display.automatic_range);
    ImGui::TextDisabled("%.3g to %.3g", heat.low, heat.high);
  }
  ImGui::Checkbox("Mesh", &workspace.display.show_mesh);
}

void history_section(Workspace& workspace) {
  const History& history = workspace.document.history();
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
}

}  // namespace

void draw_inspector(Workspace& workspace, LayerPanel& layers, const HeatScale& heat, double scale,
                    Theme theme) {
  const PanelSizes sizes = PanelSizes::at(scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(
      {display.x - static_cast<float>(sizes.inspector), static_cast<float>(sizes.menu)});
  ImGui::SetNextWindowSize({static_cast<float>(sizes.inspector),
                            display.y - static_cast<float>(sizes.menu + sizes.status)});
  ImGui::Begin("Inspector", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  const auto section = [&](const char* title, bool opens, auto draw, bool has_to = false) {
    ImGui::SetNextItemOpen(opens || has_to, has_to ? ImGuiCond_Always : ImGuiCond_Appearing);
    // Titles are subdued, because the contents of a section matter more.
    ImGui::PushStyleColor(ImGuiCol_Header, {0, 0, 0, 0});
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const bool open = ImGui::CollapsingHeader(title);
    ImGui::PopStyleColor(2);
    if (!open) return;
    ImGui::PushID(title);
    draw();
    ImGui::PopID();
    ImGui::Spacing();
  };
  // Layers come first, because the first section does not move when other sections grow.
  section(
      "Layers", true, [&] { layers.draw(workspace, scale); }, layers.is_renaming());
  section("Method", true, [&] {
    method_section(workspace);
    convergence_section(workspace, scale);
  });
  if (workspace.map().has_map())
    section("Folds", true, [&] { injectivity_section(workspace, theme); });
  section("Selection", true, [&] { selection_section(workspace); });
  section("Cage", false, [&] { cage_section(workspace); });
  section("View", true, [&] { heat_section(workspace, heat); });
  section("History", true, [&] { history_section(workspace); });
  ImGui::End();
}

}  // namespace holomorph
