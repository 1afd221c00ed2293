// The panel on the right: layers, method, folds, selection, cage, view and history.
#include <utility>

#include "app/panels/layer_panel.h"
#include "app/panels/map_panel.h"
#include "app/panels/panels.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/tools/transform_box.h"
#include "scene/auto_cage.h"

namespace holomorph {
namespace {

/// A number field. Dragging it previews the change, and releasing it commits one step.
template <class Edit>
void edit_number(const char* label, double value, const char* format, float speed,
                 Workspace& workspace, const char* step, Edit edit) {
  double number = value;
  const bool changed = ImGui::DragScalar(label, ImGuiDataType_Double, &number, speed, nullptr,
                                         nullptr, format, ImGuiSliderFlags_NoRoundToFormat);
  if (changed && std::isfinite(number))
    workspace.shown.preview = edit(workspace.shown.base(), number);
  if (ImGui::IsItemDeactivatedAfterEdit() && workspace.shown.preview)
    workspace.commit(step, *workspace.shown.preview);
}

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
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.hint.c_str());
    }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", method.hint.c_str());
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
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", spec.hint.c_str());
  }
  if (workspace.map().has_map() && !workspace.map().map().note.empty())
    wrapped_text(workspace.map().map().note);
}

/// Draws fields for a corner's angles and for the tension of the edge after it.
void corner_angles(Workspace& workspace, Index vertex) {
  const Deformation deformation = workspace.shown.deformation();
  if (!has_method_for(deformation, MethodUse::corners) || workspace.mode == EditMode::rest) return;
  if (!is_corner(deformation, vertex))
    return ImGui::TextDisabled("This point is not a corner with angles.");
  const PoseCorner pose = corner_at(deformation, vertex);
  const double turn = (pose.before + pose.after) / 2, opening = corner_opening(deformation, vertex);
  const auto edit = [&](const char* label, double radians, const char* step, auto change) {
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
    edit_number(
        label, radians * 180 / kPi, "%.1f degrees", 0.5f, workspace, step,
        [&](const Deformation& s, double degrees) { return change(s, degrees * kPi / 180); });
  };
  edit("Turn", turn, "Turn corner", [&](const Deformation& s, double angle) {
    const PoseCorner now = corner_at(s, vertex);
    return corner_turned(s, vertex, angle - (now.before + now.after) / 2);
  });
  edit("Opening", opening, "Open corner", [&](const Deformation& s, double angle) {
    return corner_opened(s, vertex, (angle - corner_opening(s, vertex)) / 2);
  });
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number(
      "Next edge tension", pose.tension, "%.2f", 0.01f, workspace, "Tension",
      [&](const Deformation& s, double tension) { return with_tension(s, vertex, tension); });
}

void one_handle(Workspace& workspace, Handle handle) {
  const Deformation deformation =
      workspace.shown.deformation();  // a copy, because a commit replaces the original
  const EditMode mode = workspace.mode;
  const Complex z = position_of(deformation, handle, mode);
  const bool pin = handle.kind == Handle::Kind::pin;
  ImGui::Text("%s %d, %s",
              pin                                          ? "Pin"
              : handle.kind == Handle::Kind::stroke        ? "Stroke"
              : handle.control > 0                         ? "Curve point of segment"
              : is_smooth(deformation, handle.index, mode) ? "Smooth cage point"
                                                           : "Cage point",
              static_cast<int>(handle.index) + 1, mode == EditMode::rest ? "at rest" : "posed");
  const float speed = static_cast<float>(1 / workspace.display.viewport.zoom);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("x", z.real(), "%.1f px", speed, workspace, "Move",
              [&](const Deformation& s, double x) {
                return placed(s, handle, {x, position_of(s, handle, mode).imag()}, mode);
              });
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("y", z.imag(), "%.1f px", speed, workspace, "Move",
              [&](const Deformation& s, double y) {
                return placed(s, handle, {position_of(s, handle, mode).real(), y}, mode);
              });
  if (handle.kind == Handle::Kind::stroke) return;
  if (!pin) {
    ImGui::Text("Curve degree %d", cage_of(deformation, mode).degree(handle.index));
    for (const char* id : {"cage.raise", "cage.lower"}) {
      ImGui::SameLine();
      if (ImGui::SmallButton(id == std::string("cage.raise") ? "+" : "-")) run(id, workspace);
    }
    if (handle.control == 0) corner_angles(workspace, handle.index);
    return;
  }
  int depth = deformation.pins[handle.index].depth;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (ImGui::InputInt("Depth", &depth)) {
    Deformation after = deformation;
    after.pins[handle.index].depth = std::clamp(depth, -kMaxDepth, kMaxDepth);
    workspace.commit_or_amend("Pin depth", std::move(after));
  }
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "Where parts of the picture overlap, the part around the pin of greater depth is on top");
  if (mode == EditMode::rest) return;
  if (const auto place = workspace.map().pin_image(deformation, static_cast<size_t>(handle.index)))
    if (const double off = std::abs(*place - z); off * workspace.display.viewport.zoom > 1)
      ImGui::TextWrapped(
          off < 10 ? "The picture stops %.1f px short." : "The picture stops %.0f px short.", off);
  bool turns = deformation.pins[handle.index].angle.has_value();
  if (ImGui::Checkbox("Fix rotation", &turns)) {
    Deformation after = deformation;
    after.pins[handle.index].angle = turns ? std::optional(0.0) : std::nullopt;
    workspace.commit(turns ? "Fix rotation" : "Free rotation", after);
  }
  if (!deformation.pins[handle.index].angle ||
      !workspace.shown.deformation().pins[handle.index].angle)
    return;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("Rotation", *deformation.pins[handle.index].angle * 180 / kPi, "%.1f degrees", 0.5f,
              workspace, "Rotate pin", [&](const Deformation& s, double degrees) {
                return turned(s, handle.index, degrees * kPi / 180);
              });
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("Scale", 100 * deformation.pins[handle.index].scale, "%.0f %%", 0.5f, workspace,
              "Scale pin", [&](const Deformation& s, double percent) {
                return scaled(s, handle.index,
                              std::max(percent, 1.0) / 100 / s.pins[handle.index].scale);
              });
}

void many_handles(Workspace& workspace) {
  const Selection selection = workspace.selection;
  const EditMode mode = workspace.mode;
  ImGui::Text("%d handles, centered at", static_cast<int>(selection.size()));
  const Complex center = center_of(workspace.shown.deformation(), selection, mode);
  const float speed = static_cast<float>(1 / workspace.display.viewport.zoom);
  const auto moved_to = [&](const Deformation& deformation, Complex to) {
    return moved(deformation, selection, to - center_of(deformation, selection, mode), mode);
  };
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("x", center.real(), "%.1f px", speed, workspace, "Move",
              [&](const Deformation& s, double x) {
                return moved_to(s, {x, center_of(s, selection, mode).imag()});
              });
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  edit_number("y", center.imag(), "%.1f px", speed, workspace, "Move",
              [&](const Deformation& s, double y) {
                return moved_to(s, {center_of(s, selection, mode).real(), y});
              });
}

/// A number field for relative changes. After each change, it returns to `neutral` (0 or 100 %).
template <class Edit>
void step_number(const char* label, double neutral, const char* format, Workspace& workspace,
                 const char* step, Edit edit) {
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(label);
  float number = storage.GetFloat(id, static_cast<float>(neutral));
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (ImGui::DragFloat(label, &number, 0.5f, 0, 0, format) && std::isfinite(number)) {
    storage.SetFloat(id, number);
    workspace.shown.preview = edit(workspace.shown.base(), static_cast<double>(number));
  }
  if (ImGui::IsItemDeactivatedAfterEdit() && workspace.shown.preview)
    workspace.commit(step, *workspace.shown.preview);
  if (!ImGui::IsItemActive()) storage.SetFloat(id, static_cast<float>(neutral));
}

/// Draws fields that rotate and scale the selection about its center.
void turn_and_scale(Workspace& workspace) {
  const Selection selection = workspace.selection;
  const EditMode mode = workspace.mode;
  step_number("Rotate by", 0, "%.1f degrees", workspace, "Rotate",
              [&](const Deformation& s, double degrees) {
                const double angle = degrees * kPi / 180;
                return transformed(s, selection,
                                   Affine::turning(angle, center_of(s, selection, mode)), angle,
                                   mode);
              });
  step_number(
      "Scale by", 100, "%.1f %%", workspace, "Scale", [&](const Deformation& s, double percent) {
        const double scale = std::max(percent, 1.0) / 100;
        return transformed(s, selection,
                           Affine::scaling(scale, scale, center_of(s, selection, mode)), 0, mode);
      });
}

void selection_section(Workspace& workspace) {
  if (workspace.selection.empty()) {
    ImGui::TextDisabled("Nothing is selected.");
    return;
  }
  if (workspace.selection.size() == 1) {
    one_handle(workspace, *workspace.selection.begin());
  } else {
    many_handles(workspace);
  }
  if (workspace.selection.size() > 1 || workspace.selection.begin()->kind == Handle::Kind::stroke)
    turn_and_scale(workspace);
  for (const char* id : {"edit.reset", "edit.delete"}) {
    const Action& action = workspace.actions.named(id);
    if (ImGui::Button(action.label.c_str())) run(action, workspace);
    tooltip_of(workspace.actions.named(id));
    ImGui::SameLine();
  }
  ImGui::NewLine();
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
        "%d cage points, %s, %s", static_cast<int>(deformation.rest.size()),
        counted(deformation.pins.size(), "pin", method_named(deformation.method).uses_pins).c_str(),
        counted(deformation.strokes.size(), "stroke", method_named(deformation.method).uses_strokes)
            .c_str());
  else
    ImGui::TextDisabled("No cage yet.");
  points_slider(workspace, ImGui::GetContentRegionAvail().x * 0.55f);
  float margin = static_cast<float>(std::max(workspace.tools.auto_cage.margin, -1.0));
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (ImGui::SliderFloat("Margin", &margin, -1, 200, margin < 0 ? "Automatic" : "%.0f px",
                         ImGuiSliderFlags_AlwaysClamp))
    workspace.tools.auto_cage.margin = margin < 0 ? -1 : margin;
  ImGui::Checkbox("Curved", &workspace.tools.auto_cage.curved);
  const Action& action = workspace.actions.named("cage.from_picture");
  ImGui::BeginDisabled(!action.enabled(workspace));
  if (ImGui::Button("Make from picture")) run(action, workspace);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("Replaces the cage with one around the largest opaque part of the picture");
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
