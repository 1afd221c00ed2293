// The panel holds the name that is being typed. The scene changes only when typing ends.
#include "app/panels/layer_panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/look/controls.h"
#include "app/look/imgui_versions.h"
#include "app/look/numbers.h"
#include "app/panels/panels.h"
#include "edit/actions/icons.h"
#include "edit/edits/method_edits.h"

namespace holomorph {
namespace {

constexpr size_t kMostRows = 5;  ///< more layers scroll

std::string counted(size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// What a row says about its layer, such as "Puppet, 10 pins".
std::string summary_of(const Scene& scene, size_t number) {
  const Layer& layer = *scene.layers[number];
  if (layer.attachment) return "Follows " + attachment_text(scene, number);
  const Deformation& deformation = layer.deformation;
  if (!deformation.has_cage()) return "Not bent";
  const Method& method = chosen_method(deformation);
  std::string text = method.label;
  if (method.uses_pins && !deformation.pins.empty())
    text += ", " + counted(deformation.pins.size(), "pin");
  if (method.uses_strokes && !deformation.strokes.empty())
    text += ", " + counted(deformation.strokes.size(), "stroke");
  return text;
}

/// An arrow that turns from the row's middle down to the layer below.
void draw_clip_arrow(ImDrawList& list, ImVec2 corner, ImU32 ink) {
  const float arm = px(7), head = px(3), thickness = px(1.5f);
  const ImVec2 tip = corner + ImVec2(0, arm);
  list.AddLine(corner + ImVec2(arm, 0), corner, ink, thickness);
  list.AddLine(corner, tip, ink, thickness);
  list.AddLine(tip, tip + ImVec2(-head, -head), ink, thickness);
  list.AddLine(tip, tip + ImVec2(head, -head), ink, thickness);
}

}  // namespace

void LayerPanel::rename(const Scene& scene) {
  renamed_id_ = scene.layer().id;
  name_ = title_of_layer(scene, scene.edited);
  focus_field_ = true;
}

void LayerPanel::draw_name(Workspace& workspace, size_t layer, float width) {
  if (std::exchange(focus_field_, false)) ImGui::SetKeyboardFocusHere();
  text_field("##name", name_, "", width, ImGuiInputTextFlags_AutoSelectAll);
  if (!ImGui::IsItemDeactivated()) return;
  const bool cancelled = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  renamed_id_ = 0;
  if (cancelled || name_.empty()) return;
  const Scene& scene = workspace.document.scene();
  Layer state = *scene.layers[layer];
  state.name = name_;
  workspace.commit_layers("Rename layer", with_layer_at(scene, layer, state));
}

void LayerPanel::draw_row(Workspace& workspace, size_t layer, Thumbnails& thumbnails) {
  const ThemeColors& c = theme_colors();
  const Scene& scene = workspace.document.scene();
  const SharedLayer shared = scene.layers[layer];  // a copy, because commits replace the scene
  const Layer& state = *shared;
  ImGui::PushID(state.id);
  const auto toggle_flag = [&](bool Layer::*flag, const char* label) {
    Layer changed = state;
    changed.*flag = !(state.*flag);
    workspace.commit_layers(label, with_layer_at(workspace.document.scene(), layer, changed));
  };
  const bool edited = layer == scene.edited, renames = renamed_id_ == state.id;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = px(48), side = px(36),
              small = px(24), indent = clip_base(scene, layer) ? px(16) : 0;
  allow_overlap_of_next_item();
  const bool clicked = ImGui::InvisibleButton("row", {width, height});
  const bool hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem |
                                            ImGuiHoveredFlags_RectOnly) &&
                       ImGui::IsWindowHovered();
  const bool double_clicked = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0);
  allow_overlap_of_last_item();
  name_item("Layer: " + title_of_layer(scene, layer));
  if (ImGui::GetMousePos().x < at.x + width - 3 * small - px(8))
    tooltip(edited ? "Double-click to rename." : "Click to edit this layer.");
  draw_focus_ring(px(6));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (edited || hovered)
    list.AddRectFilled(at, at + ImVec2(width, height), faded(edited ? c.accent_tint : c.hover),
                       px(6));
  if (edited && has_high_contrast())
    list.AddRect(at, at + ImVec2(width, height), faded(c.accent), px(6), 0, px(2));
  const float alpha = state.visible ? 1 : 0.4f;
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * alpha);
  draw_thumbnail(list, thumbnails.of_picture(workspace.document.pictures().still(state)),
                 at + ImVec2(indent + px(8), (height - side) / 2), side, px(4));
  if (indent > 0) draw_clip_arrow(list, at + ImVec2(px(14), height / 2), faded(c.muted));
  ImGui::PopStyleVar();
  const float left = indent + px(8) + side + px(10), buttons = 3 * small + px(8);
  const float room = width - left - buttons;
  if (!renames) {
    const ImU32 ink = state.visible ? c.text : c.muted;
    draw_text(list, Type::body, at + ImVec2(left, px(6)), ink,
              shortened_text(title_of_layer(scene, layer), room));
    const ScopedFont small_font(Type::caption);
    draw_text(list, Type::caption, at + ImVec2(left, px(26)), c.muted,
              shortened_text(summary_of(scene, layer), room));
  }
  // The states that differ from the usual ones are always shown, the others on hover.
  const auto flag_button = [&](float x, const char* name, const char* icon, const char* tip,
                               bool shows, bool on = false) {
    ImGui::SetCursorScreenPos(at + ImVec2(x, (height - small) / 2));
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * (shows ? 1.0f : 0.0f));
    const bool pressed = icon_button(name, icon, tip, on, small, Type::caption);
    ImGui::PopStyleVar();
    return pressed;
  };
  const float attach = width - buttons, lock = attach + small, eye = width - small - px(4);
  const bool attached = state.attachment.has_value();
  const char* attach_id = attached ? "layer.detach" : "layer.attach";
  const std::string attach_tip =
      attached ? "Follows " + attachment_text(scene, layer) + ". Click to detach."
               : "Attach to another layer. Then click a pin, a stroke or a point on it.";
  if ((attached || may_follow_any(scene, layer)) &&
      flag_button(attach, "attach", icon_named("attach"), attach_tip.c_str(),
                  attached || hovered || edited, attached)) {
    workspace.choose_layer(layer);
    run(workspace.actions.named(attach_id), workspace);
  } else if (flag_button(lock, "lock", state.locked ? icon_named("lock") : icon_named("unlock"),
                         state.locked ? "Locked. Click to unlock." : "Click to prevent edits.",
                         state.locked || hovered || edited)) {
    toggle_flag(&Layer::locked, state.locked ? "Unlock layer" : "Lock layer");
  } else if (flag_button(eye, "shown", state.visible ? icon_named("eye") : icon_named("eye-off"),
                         state.visible ? "Visible. Click to hide." : "Hidden. Click to show.",
                         true)) {
    toggle_flag(&Layer::visible, state.visible ? "Hide layer" : "Show layer");
  } else if (clicked) {
    workspace.choose_layer(layer);
  }
  if (double_clicked && workspace.document.scene().edited == layer)
    rename(workspace.document.scene());
  if (renames) {
    ImGui::SetCursorScreenPos(at + ImVec2(left - px(4), (height - px(28)) / 2));
    draw_name(workspace, layer, room);
  }
  ImGui::SetCursorScreenPos(at + ImVec2(0, height + px(2)));
  ImGui::Dummy({0, 0});
  ImGui::PopID();
}

/// The opacity and the blending mode of the edited layer.
void LayerPanel::draw_ink(Workspace& workspace) {
  const Scene& scene = workspace.document.scene();
  double percent = 100 * scene.layer().opacity;
  const Change change =
      slider_row("Opacity", percent, {.low = 0, .high = 100, .unit = "%", .neutral = 100.0});
  if (change.changed) {
    Layer layer = scene.layer();
    layer.opacity = std::round(percent) / 100;
    workspace.commit_or_amend_layers("Opacity", with_layer(scene, std::move(layer)));
  }
  if (change.ended) workspace.end_mergeable_step();
  static constexpr const char* kLabels[] = {"Normal", "Multiply", "Screen", "Overlay", "Add"};
  const auto mode = static_cast<size_t>(workspace.document.scene().layer().blending);
  row_label("Blending", "How the layer's colors combine with those below it");
  if (!begin_dropdown("##Blending", kLabels[mode])) return;
  for (size_t i = 0; i < std::size(kLabels); ++i)
    if (dropdown_row(kLabels[i], i == mode)) {
      Layer layer = workspace.document.scene().layer();
      layer.blending = static_cast<Blending>(i);
      workspace.commit_layers("Blending mode",
                              with_layer(workspace.document.scene(), std::move(layer)));
    }
  end_dropdown();
}

void LayerPanel::draw_clipping(Workspace& workspace) {
  const Action& clip = workspace.actions.named("layer.clip");
  if (!clip.enabled(workspace)) return;
  if (switch_row("Clip", clip.checked(workspace), clip.hint)) run(clip, workspace);
}

void LayerPanel::draw(Workspace& workspace, Thumbnails& thumbnails) {
  const size_t count = workspace.document.scene().layers.size();
  const float bleed = px(8);  // rows reach beyond the column of text
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() - bleed);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_part("rows", {ImGui::GetContentRegionAvail().x + bleed,
                      px(50) * static_cast<float>(std::clamp<size_t>(count, 1, kMostRows))});
  for (size_t i = workspace.document.scene().layers.size(); i-- > 0;)
    if (i < workspace.document.scene().layers.size()) draw_row(workspace, i, thumbnails);
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
  draw_ink(workspace);
  draw_clipping(workspace);
  for (const char* id : {"layer.add", "layer.double", "layer.up", "layer.down"}) {
    action_icon_button(id, workspace);
    ImGui::SameLine(0, px(4));
  }
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - px(28));
  action_icon_button("layer.delete", workspace);
}

}  // namespace holomorph
