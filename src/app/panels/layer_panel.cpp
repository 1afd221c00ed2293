// The panel holds the name that is being typed. The scene changes only when typing ends.
#include "app/panels/layer_panel.h"

#include <utility>

#include "app/panels/panels.h"
// Must follow imgui.h, because it does not include that header itself.
#include <imgui_stdlib.h>

namespace holomorph {
namespace {

/// Glyphs of Font Awesome 4.
constexpr const char *kShown = "\uf06e", *kHidden = "\uf070", *kLocked = "\uf023",
                     *kUnlocked = "\uf09c";

/// A small button with one of two icons. Returns whether it was pressed.
bool toggle(const char* id, bool on, const char* on_face, const char* off_face, const char* tip,
            float width) {
  if (!on) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushStyleColor(ImGuiCol_Button, {0, 0, 0, 0});
  const bool pressed = ImGui::Button((std::string(on ? on_face : off_face) + "###" + id).c_str(),
                                     {width, ImGui::GetFrameHeight()});
  ImGui::PopStyleColor(on ? 1 : 2);
  tooltip(tip);
  return pressed;
}

void background_row(Workspace& workspace) {
  static constexpr const char* kIds[] = {"background.transparent", "background.color",
                                         "background.original"};
  static constexpr const char* kNames[] = {"Transparent", "Color", "Original picture"};
  Scene scene = workspace.document.scene();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (begin_combo("Background", kNames[static_cast<int>(scene.background.fill)])) {
    for (int i = 0; i < 3; ++i)
      if (const Action& action = workspace.actions.named(kIds[i]);
          ImGui::Selectable(kNames[i], action.checked(workspace)))
        run(action, workspace);
    ImGui::EndCombo();
  }
  tooltip("What is shown and exported where the picture is transparent or has moved away");
  if (scene.background.fill != Background::Fill::color) return;
  float color[3];
  for (size_t k = 0; k < 3; ++k) color[k] = static_cast<float>(scene.background.color[k]) / 255;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.75f);
  if (ImGui::ColorEdit3("##color", color, ImGuiColorEditFlags_DisplayHex)) {
    for (size_t k = 0; k < 3; ++k)
      scene.background.color[k] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0f, 1.0f)));
    workspace.commit_or_amend_layers("Background color", scene);
  }
}

}  // namespace

void LayerPanel::rename(const Scene& scene) {
  renamed_id_ = scene.layer().id;
  name_ = title_of_layer(scene, scene.edited);
  focus_field_ = true;
}

void LayerPanel::draw_name(Workspace& workspace, size_t layer) {
  ImGui::SetNextItemWidth(-1);
  if (std::exchange(focus_field_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::InputText("##name", &name_, ImGuiInputTextFlags_AutoSelectAll);
  if (!ImGui::IsItemDeactivated()) return;
  const bool cancelled = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  renamed_id_ = 0;
  if (cancelled || name_.empty()) return;
  const Scene& scene = workspace.document.scene();
  Layer state = *scene.layers[layer];
  state.name = name_;
  workspace.commit_layers("Rename layer", with_layer_at(scene, layer, state));
}

void LayerPanel::draw_row(Workspace& workspace, size_t layer, float s) {
  const Scene& scene = workspace.document.scene();
  const SharedLayer shared = scene.layers[layer];  // a copy, because commits replace the scene
  const Layer& state = *shared;
  ImGui::PushID(state.id);
  const auto toggle_flag = [&](bool Layer::*flag, const char* label) {
    Layer changed = state;
    changed.*flag = !(state.*flag);
    workspace.commit_layers(label, with_layer_at(workspace.document.scene(), layer, changed));
  };
  if (toggle("shown", state.visible, kShown, kHidden,
             state.visible ? "Visible. Click to hide." : "Hidden. Click to show.", 30 * s)) {
    toggle_flag(&Layer::visible, state.visible ? "Hide layer" : "Show layer");
  }
  ImGui::SameLine(0, 0);
  if (toggle("locked", state.locked, kLocked, kUnlocked,
             state.locked ? "Locked. Click to unlock." : "Unlocked. Click to prevent edits.",
             30 * s)) {
    toggle_flag(&Layer::locked, state.locked ? "Unlock layer" : "Lock layer");
  }
  ImGui::SameLine(0, 8 * s);
  if (renamed_id_ == state.id) {
    draw_name(workspace, layer);
  } else {
    const std::string title = title_of_layer(workspace.document.scene(), layer);
    const bool edited = layer == workspace.document.scene().edited;
    if (text_row(0, title, edited, {0, ImGui::GetTextLineHeight()},
                 ImGuiSelectableFlags_AllowDoubleClick)) {
      workspace.choose_layer(layer);
      if (ImGui::IsMouseDoubleClicked(0)) rename(workspace.document.scene());
    }
    tooltip(edited ? "Current layer. Double-click to rename."
                   : "Click to edit this layer. Double-click to rename.");
  }
  ImGui::PopID();
}

void LayerPanel::draw(Workspace& workspace, double scale) {
  const float s = static_cast<float>(scale);
  const size_t count = workspace.document.scene().layers.size();
  // Show at most five rows, to leave room for the other sections.
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
  begin_part("rows",
             {0, ImGui::GetFrameHeight() * static_cast<float>(std::clamp<size_t>(count, 1, 5))});
  for (size_t i = workspace.document.scene().layers.size(); i-- > 0;)
    if (i < workspace.document.scene().layers.size()) draw_row(workspace, i, s);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  for (const char* id : {"layer.add", "layer.double", "layer.up", "layer.down", "layer.delete"}) {
    const Action& action = workspace.actions.named(id);
    ImGui::BeginDisabled(!action.enabled(workspace));
    if (ImGui::Button((std::string(action.icon) + "###" + id).c_str(), {36 * s, 0}))
      run(action, workspace);
    ImGui::EndDisabled();
    tooltip_of(workspace.actions.named(id));
    ImGui::SameLine(0, 4 * s);
  }
  ImGui::NewLine();
  background_row(workspace);
}

}  // namespace holomorph
