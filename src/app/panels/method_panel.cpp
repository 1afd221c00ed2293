// Methods are shown by what they do. Their settings are closed until someone wants them.
#include "app/panels/method_panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>

#include "app/look/controls.h"
#include "app/look/method_picture.h"
#include "app/panels/edit_value.h"
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "edit/edits/method_edits.h"
#include "edit/method_choice.h"

namespace holomorph {
namespace {

constexpr const char* kCards[] = {"sheet", "pins", "cage"};

/// Methods that a tool switches to, and the one behind the switch, are not in the list.
bool is_listed(const Method& method) {
  const bool draws_strokes = method.uses_strokes && !method.pins_replace_cage;
  return !has_card(method.id) && !draws_strokes && !method.uses_outline && !method.uses_corners;
}

/// A row of the list under "More": picture, name and summary.
bool method_row(const Method& method, bool chosen) {
  const ThemeColors& c = theme_colors();
  const ImVec2 at = ImGui::GetCursorScreenPos(), size(px(440), px(56));
  const bool clicked = ImGui::Selectable(("##" + method.id).c_str(), chosen, 0, size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_method_picture(list, method.id, at + ImVec2(px(32), size.y / 2), 0.8f, c.control, c.raised);
  draw_text(list, Type::body, at + ImVec2(px(72), px(9)), c.text, method.label);
  draw_text(list, Type::caption, at + ImVec2(px(72), px(29)), c.muted, method.summary);
  name_item(method.label);
  return clicked;
}

void more_methods(Workspace& workspace, const Method& chosen) {
  const bool opens = small_button("More##methods", ButtonKind::flat);
  name_item("More methods");
  if (opens) ImGui::OpenPopup("methods");
  if (!begin_menu_popup("methods")) return;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, px(4)});
  for (const Method& method : methods())
    if (is_listed(method) && method_row(method, method.id == chosen.id)) {
      choose_method(workspace, method.id);
      ImGui::CloseCurrentPopup();
    }
  ImGui::PopStyleVar();
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) ImGui::CloseCurrentPopup();
  end_menu_popup();
}

void preset_row(Workspace& workspace, const Deformation& deformation, const Method& method) {
  row_label("Preset");
  std::string preview = "Custom";
  for (const Preset& preset : method.presets)
    if (with_preset(deformation, preset).parameters == deformation.parameters)
      preview = preset.label;
  if (!begin_dropdown("##Preset", preview)) return;
  for (const Preset& preset : method.presets)
    if (dropdown_row(preset.label, preview == preset.label))
      workspace.commit(preset.label, with_preset(deformation, preset));
  end_dropdown();
}

/// The settings of the chosen method, and the limits that prevent folds.
void settings(Workspace& workspace) {
  const Deformation deformation = workspace.shown.deformation();
  const Method& method = chosen_method(deformation);
  const Parameters chosen = chosen_parameters(deformation);
  const ScopedLabelWidth wide(px(104));
  for (const ParameterSpec& spec : method.parameters)
    if (is_used(method, chosen, spec) && (!spec.needs_parts || !deformation.rest.parts.empty()))
      parameter_row(workspace, method, spec);
  if (!prevents_folds(deformation)) return;
  const Method& bounded = method_named(deformation.method);
  if (!bounded.presets.empty()) preset_row(workspace, deformation, bounded);
  for (const ParameterSpec& spec : bounded.parameters)
    if (spec.key != "reference" && is_used(bounded, deformation.parameters, spec))
      parameter_row(workspace, bounded, spec);
}

/// The line that opens the settings. Returns whether it was clicked.
bool settings_title(bool open) {
  const ThemeColors& c = theme_colors();
  const ImVec2 at = ImGui::GetCursorScreenPos(), size(ImGui::GetContentRegionAvail().x, px(24));
  const bool clicked = ImGui::InvisibleButton("Settings", size);
  const ImU32 ink = ImGui::IsItemHovered() ? c.text : c.muted;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_icon(list, open ? icon_named("down") : icon_named("right"), at + ImVec2(px(8), size.y / 2),
            ink, Type::caption);
  draw_text(list, Type::body, at + ImVec2(px(20), (size.y - font(Type::body)->FontSize) / 2), ink,
            "Settings");
  draw_focus_ring(px(4));
  name_item("Settings");
  return clicked;
}

}  // namespace

bool has_card(const std::string& method) {
  return std::ranges::find(kCards, method, [](const char* id) { return std::string(id); }) !=
         std::end(kCards);
}

bool method_card(const std::string& id, const std::string& label, const std::string& picture,
                 bool chosen, float width) {
  const ThemeColors& c = theme_colors();
  const ImVec2 size(width, px(88));
  const bool clicked = ImGui::InvisibleButton(id.c_str(), size);
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const ImU32 surface = chosen ? c.accent_tint : hovered ? c.hover : c.field;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, to, faded(surface), px(8));
  list.AddRect(from, to, faded(chosen ? c.accent : c.line), px(8), 0, chosen ? px(2) : 1);
  draw_method_picture(list, picture, {(from.x + to.x) / 2, from.y + px(35)},
                      std::min(1.0f, (width - px(8)) / px(72)), chosen ? c.text : c.control,
                      surface);
  draw_centered_text(list, chosen ? Type::strong : Type::body, {from.x, to.y - px(26)},
                     {to.x, to.y - px(4)}, chosen || hovered ? c.text : c.muted, label);
  draw_focus_ring(px(8));
  name_item(label);
  return clicked;
}

PanelAnswer method_section(Workspace& workspace, Preferences& preferences) {
  PanelAnswer answer;
  const Method& method = chosen_method(workspace.shown.deformation());
  // Without a cage, the first pin chooses the method.
  const bool has_method =
      workspace.shown.deformation().has_cage() || method.id != usual_method(MethodUse::cage).id;
  // "More" stands in the title's row.
  const ImVec2 below = ImGui::GetCursorPos();
  const float more = text_size(Type::strong, "More").x + px(20);
  ImGui::SetCursorPos({below.x + ImGui::GetContentRegionAvail().x - more - px(22),
                       below.y - ImGui::GetStyle().ItemSpacing.y - px(26)});
  more_methods(workspace, method);
  ImGui::SetCursorPos(below);
  const float gap = px(8), width = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  for (size_t i = 0; i < std::size(kCards); ++i) {
    const Method& each = method_named(kCards[i]);
    if (i > 0) ImGui::SameLine(0, gap);
    if (method_card(each.id, each.label, each.id, has_method && each.id == method.id, width))
      choose_method(workspace, each.id);
    tooltip(each.hint);
  }
  if (!has_card(method.id)) ImGui::TextUnformatted(method.label.c_str());
  caption(has_method ? method.summary : "No method yet. The first pin chooses Puppet.");
  if (has_method) tooltip(method.hint);
  if (can_prevent_folds(method)) {
    const bool prevents = prevents_folds(workspace.shown.deformation());
    const ScopedLabelWidth wide(px(112));
    if (switch_row("Prevent folds", prevents,
                   "Keep sizes and shapes within limits, so that "
                   "nothing folds. This is proved for every frame."))
      run("map.fold_free", workspace);
  }
  bool& open = preferences.sections.try_emplace("settings", false).first->second;
  const bool has_settings =
      !method.parameters.empty() || prevents_folds(workspace.shown.deformation());
  if (has_settings && settings_title(open)) {
    open = !open;
    answer.preferences_changed = true;
  }
  if (open && has_settings) settings(workspace);
  if (workspace.map().has_map() && !workspace.map().map().note.empty() &&
      workspace.map().map().status != SampledMap::Status::certified)
    caption(workspace.map().map().note);
  return answer;
}

}  // namespace holomorph
