// The bar over the canvas: options of the active tool and of what is selected. Groups that do not
// fit move into a list under "More".
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "app/look/controls.h"
#include "app/look/surfaces.h"
#include "app/panels/edit_value.h"
#include "app/panels/panels.h"
#include "edit/actions/groups.h"
#include "edit/actions/icons.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/edits/method_edits.h"
#include "edit/frame.h"
#include "edit/picking.h"

namespace holomorph {
namespace {

/// Options that belong together. `draw` draws them in one row.
struct OptionGroup {
  const char* name;
  std::function<void()> draw;
};
using OptionGroups = std::vector<OptionGroup>;

void inline_label(const std::string& label, const std::string& hint = "") {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size = text_size(Type::body, label);
  draw_text(*ImGui::GetWindowDrawList(), Type::body, {at.x, at.y + (px(28) - size.y) / 2},
            theme_colors().muted, label);
  ImGui::Dummy({size.x, px(28)});
  tooltip(hint);
  ImGui::SameLine(0, px(8));
}

/// An action as a flat button with its icon and name.
void action_option(const std::string& id, const std::string& label, Workspace& workspace) {
  const Action& action = workspace.actions.named(id);
  const bool on = action.checked && action.checked(workspace);
  ImGui::BeginDisabled(!action.enabled(workspace));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = px(20) + px(6) + text_size(Type::strong, label).x + px(12), height = px(28);
  const bool pressed = ImGui::InvisibleButton(id.c_str(), {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ThemeColors& c = theme_colors();
  if (hovered || on)
    list.AddRectFilled(at, at + ImVec2(width, height), faded(on ? c.accent_tint : c.hover), px(6));
  const ImU32 ink = on ? c.accent : hovered ? c.text : c.muted;
  draw_icon(list, action.icon, at + ImVec2(px(16), height / 2), ink);
  draw_text(list, Type::strong, at + ImVec2(px(30), (height - font(Type::strong)->FontSize) / 2),
            ink, label);
  draw_focus_ring(px(6));
  name_item(label);
  tooltip_of(action);
  ImGui::EndDisabled();
  if (pressed) run(id, workspace);
}

std::vector<Index> selected_pins(const Workspace& workspace) {
  std::vector<Index> pins;
  for (const Handle& handle : workspace.selection)
    if (handle.kind == Handle::Kind::pin &&
        exists(workspace.shown.deformation(), handle, workspace.mode))
      pins.push_back(handle.index);
  return pins;
}

bool selects_cage_points(const Workspace& workspace) {
  return std::ranges::any_of(
      workspace.selection, [](const Handle& handle) { return handle.kind == Handle::Kind::cage; });
}

const ParameterSpec* spec_named(const Method& method, const std::string& key) {
  const auto found = std::ranges::find(method.parameters, key, &ParameterSpec::key);
  return found == method.parameters.end() ? nullptr : &*found;
}

/// How exactly the pins are met.
void add_pin_fit(OptionGroups& groups, Workspace& workspace) {
  const Method& method = chosen_method(workspace.shown.deformation());
  const ParameterSpec *exact = spec_named(method, "exact"),
                      *weight = spec_named(method, "pin_weight");
  const auto value = [&workspace, &method](const ParameterSpec& spec) {
    return parameter(method, chosen_parameters(workspace.shown.deformation()), spec.key);
  };
  if (exact)
    groups.push_back(
        {"mode", [&workspace, &method, exact, value] {
           inline_label("Mode", exact->hint);
           const bool is_exact = value(*exact) != 0;
           if (const auto clicked = segmented("Mode", {"Soft", "Exact"}, is_exact ? 1 : 0))
             workspace.commit("Pins: " + std::string(*clicked ? "exact" : "soft"),
                              with_parameter(workspace.shown.deformation(), method.id, exact->key,
                                             *clicked ? 1.0 : 0.0));
         }});
  if (weight)
    groups.push_back({"stiffness", [&workspace, &method, weight, value] {
                        ImGui::BeginDisabled(!is_used(
                            method, chosen_parameters(workspace.shown.deformation()), *weight));
                        inline_label("Pin weight", "How closely the picture follows the pins");
                        DisplayedParameter shown = displayed(*weight, value(*weight));
                        const Change change =
                            slider("##Pin weight", shown.value, shown.number, px(148));
                        apply_change(workspace, change, "Pin weight", [&](const Deformation& base) {
                          return with_parameter(base, method.id, weight->key,
                                                parameter_of(*weight, shown.value));
                        });
                        ImGui::EndDisabled();
                      }});
}

void set_rotation(Workspace& workspace, const std::vector<Index>& pins, bool fixed) {
  Deformation after = workspace.shown.deformation();
  for (const Index i : pins) {
    Pin& pin = after.pins[static_cast<size_t>(i)];
    if (fixed) pin.angle = rotation_at(workspace, i);
    if (!fixed) pin.angle.reset();
  }
  workspace.commit(fixed ? "Fix rotation" : "Free rotation", std::move(after));
}

void add_frame(OptionGroups& groups, Workspace& workspace) {
  groups.push_back(
      {"frame", [&workspace] {
         inline_label("Frame",
                      "Free: the sides of the picture follow the pins. Slide: they stay, and what "
                      "lies on them may slide along them. Fixed: nothing on them moves");
         const auto chosen = static_cast<size_t>(workspace.shown.deformation().frame);
         const auto clicked = segmented("Frame", {"Free", "Slide", "Fixed"}, chosen);
         if (!clicked || clicked == chosen) return;
         Deformation after = workspace.shown.deformation();
         after.frame = static_cast<Frame>(*clicked);
         workspace.commit("Frame", std::move(after));
       }});
}

void add_pin_groups(OptionGroups& groups, Workspace& workspace) {
  if (can_choose_frame(workspace)) add_frame(groups, workspace);
  add_pin_fit(groups, workspace);
  const std::vector<Index> pins = selected_pins(workspace);
  groups.push_back({"rotation", [&workspace, pins] {
                      ImGui::BeginDisabled(pins.empty() || workspace.mode == EditMode::rest);
                      inline_label("Rotation",
                                   "Auto: the picture turns freely around the pin. "
                                   "Fixed: the pin sets rotation and scale");
                      std::optional<size_t> chosen;
                      if (!pins.empty())
                        chosen = workspace.shown.deformation().pins[pins[0]].angle ? 1 : 0;
                      if (const auto clicked = segmented("Rotation", {"Auto", "Fixed"}, chosen))
                        set_rotation(workspace, pins, *clicked == 1);
                      ImGui::EndDisabled();
                    }});
  groups.push_back(
      {"depth", [&workspace, pins] {
         ImGui::BeginDisabled(pins.empty());
         const char* hint =
             "If parts of the picture overlap, the part near the pin with the greater depth is on "
             "top";
         inline_label("Depth", hint);
         double depth = pins.empty() ? 0 : workspace.shown.deformation().pins[pins[0]].depth;
         const double before = depth;
         if (stepper("Depth", depth, {-kMaxDepth, kMaxDepth}, px(88))) {
           Deformation after = workspace.shown.deformation();
           for (const Index i : pins) {
             int& each = after.pins[static_cast<size_t>(i)].depth;
             each = std::clamp(each + static_cast<int>(depth - before), -kMaxDepth, kMaxDepth);
           }
           workspace.commit_or_amend("Pin depth", std::move(after));
         }
         ImGui::EndDisabled();
       }});
}

void add_cage_point_groups(OptionGroups& groups, Workspace& workspace) {
  groups.push_back({"corner", [&workspace] {
                      const EditMode mode = workspace.mode;
                      bool smooth = true, any = false;
                      for (const Handle& handle : workspace.selection)
                        if (handle.kind == Handle::Kind::cage && handle.control == 0) {
                          any = true;
                          smooth = smooth &&
                                   is_smooth(workspace.shown.deformation(), handle.index, mode);
                        }
                      ImGui::BeginDisabled(!any);
                      inline_label("Point");
                      const std::optional<size_t> chosen =
                          any ? std::optional<size_t>(smooth ? 1 : 0) : std::nullopt;
                      const auto clicked = segmented("Point", {"Corner", "Smooth"}, chosen);
                      if (clicked && clicked != chosen) run("cage.corner", workspace);
                      ImGui::EndDisabled();
                    }});
  groups.push_back(
      {"degree", [&workspace] {
         inline_label("Curve degree", "1 is straight; higher degrees have more tangent points");
         double degree = 1;
         for (const Handle& handle : workspace.selection)
           if (handle.kind == Handle::Kind::cage)
             degree = cage_of(workspace.shown.deformation(), workspace.mode).degree(handle.index);
         const double before = degree;
         if (stepper("Degree", degree, {1, 8}, px(88)))
           run(degree > before ? "cage.raise" : "cage.lower", workspace);
       }});
}

void add_brush_groups(OptionGroups& groups, Workspace& workspace) {
  groups.push_back(
      {"size", [&workspace] {
         inline_label("Size");
         slider("##Size", workspace.tools.brush_radius, {1, 2000, "px", 0, true, 60.0}, px(200));
       }});
  groups.push_back({"strength", [&workspace] {
                      inline_label("Strength", "How much one dab stiffens");
                      double percent = 100 * workspace.tools.brush_strength;
                      if (slider("##Strength", percent, {5, 100, "%", 0, false, 50.0}, px(164)))
                        workspace.tools.brush_strength = percent / 100;
                    }});
  groups.push_back(
      {"clear", [&workspace] { action_option("edit.remove_stiffness", "Clear", workspace); }});
}

void add_auto_cage_groups(OptionGroups& groups, Workspace& workspace) {
  const auto add_holes = [&] {
    groups.push_back(
        {"holes", [&workspace] {
           inline_label(
               "Smallest hole",
               "Empty regions inside the picture become holes of the next cage if they are "
               "wider than this, in percent of the picture's size. 100 % fills all of them.");
           slider("##Smallest hole", workspace.tools.auto_cage.hole_width,
                  {.low = 0.1,
                   .high = 100,
                   .unit = "%",
                   .decimals = 1,
                   .logarithmic = true,
                   .neutral = 3.0},
                  px(164));
         }});
  };
  groups.push_back({"make", [&workspace] {
                      action_option("cage.from_picture", "Make from picture", workspace);
                    }});
  groups.push_back({"detail", [&workspace] {
                      inline_label("Detail", kDetailHint);
                      slider("##Detail", workspace.tools.auto_cage.detail, {0, 100}, px(148));
                    }});
  groups.push_back({"curved", [&workspace] {
                      inline_label("Curved", "Make the next cage from the picture with curves");
                      bool& curved = workspace.tools.auto_cage.curved;
                      if (toggle_switch("Curved", curved)) curved = !curved;
                    }});
  add_holes();
}

/// A slider for a parameter of the chosen method, if it has the parameter.
void add_parameter(OptionGroups& groups, Workspace& workspace, const char* key) {
  const Method& method = chosen_method(workspace.shown.deformation());
  const ParameterSpec* spec = spec_named(method, key);
  if (!spec) return;
  groups.push_back(
      {spec->key.c_str(), [&workspace, &method, spec] {
         inline_label(spec->label, spec->hint);
         DisplayedParameter shown = displayed(
             *spec, parameter(method, chosen_parameters(workspace.shown.deformation()), spec->key));
         const Change change = slider("##" + spec->label, shown.value, shown.number, px(148));
         apply_change(workspace, change, spec->label, [&](const Deformation& base) {
           return with_parameter(base, method.id, spec->key, parameter_of(*spec, shown.value));
         });
       }});
}

void add_angle_groups(OptionGroups& groups, Workspace& workspace) {
  groups.push_back({"corners", [&workspace] {
                      action_option("cage.all_corners", "All points as corners", workspace);
                    }});
}

/// What moves along with a drag.
void add_drag_groups(OptionGroups& groups, Workspace& workspace) {
  DragOptions& drag = workspace.tools.drag;
  if (drag.soft)
    groups.push_back(
        {"reach", [&drag] {
           inline_label("Radius", "Points within this radius follow a drag");
           slider("##Radius", drag.reach, {kMinReach, 2000, "px", 0, true, 100.0}, px(200));
         }});
}

void add_key_groups(OptionGroups& groups, Workspace& workspace) {
  groups.push_back(
      {"ease", [&workspace] {
         inline_label("Ease", "The motion from these keyframes to the next ones");
         const Scene& scene = workspace.document.scene();
         const KeySelection keys = workspace.shown.timeline.keys;
         const std::optional<Ease> common = common_ease(scene, keys);
         const auto chosen = common ? std::optional(static_cast<size_t>(*common)) : std::nullopt;
         if (const auto clicked = segmented("Ease", {"Smooth", "Linear", "Hold"}, chosen))
           workspace.commit_layers("Easing",
                                   with_keys_eased(scene, keys, static_cast<Ease>(*clicked)));
       }});
  groups.push_back({"between", [&workspace] {
                      inline_label("Between",
                                   "What to blend between keyframes: shapes (rotations and "
                                   "sizes) or, for comparison, positions");
                      AnimationSettings settings = workspace.document.scene().animation;
                      if (const auto clicked = segmented("Between", {"Shapes", "Positions"},
                                                         settings.linear_blend ? 1 : 0)) {
                        settings.linear_blend = *clicked == 1;
                        workspace.commit_layers(
                            "Blending", with_animation(workspace.document.scene(), settings));
                      }
                    }});
  for (const auto& [id, label] : {std::pair("time.copy_keys", "Duplicate"),
                                  {"time.mirror_keys", "Mirror"},
                                  {"time.delete_key", "Delete"}})
    groups.push_back(
        {id, [&workspace, id = id, label = label] { action_option(id, label, workspace); }});
}

/// The icon and name of the bar, and its groups.
struct Options {
  const char* icon;
  std::string name;
  OptionGroups groups;
};

Options options_of(Workspace& workspace) {
  Options options;
  OptionGroups& groups = options.groups;
  if (const size_t keys = workspace.shown.timeline.keys.size(); keys > 0) {
    options = {icon_named("key"), keys == 1 ? "Keyframe" : std::to_string(keys) + " keyframes", {}};
    add_key_groups(groups, workspace);
    return options;
  }
  const auto reset = [&] {
    groups.push_back({"reset", [&workspace] { action_option("edit.reset", "Reset", workspace); }});
  };
  switch (workspace.tools.active) {
    case ToolId::pin:
      options = {icon_named("pin"), "Pin", {}};
      if (workspace.actions.named("edit.hold_rest").enabled(workspace))
        groups.push_back({"hold", [&workspace] {
                            action_option("edit.hold_rest", "Hold the rest", workspace);
                          }});
      if (workspace.actions.named("edit.let_go").enabled(workspace))
        groups.push_back({"let go", [&workspace] {
                            action_option("edit.let_go", "Let the rest go", workspace);
                          }});
      add_pin_groups(groups, workspace);
      groups.push_back({"mesh", [&workspace] { action_option("view.mesh", "Mesh", workspace); }});
      reset();
      break;
    case ToolId::brush:
      options = {icon_named("brush"), "Stiffness", {}};
      add_brush_groups(groups, workspace);
      break;
    case ToolId::pen:
      options = {icon_named("pen"), "Pen", {}};
      add_auto_cage_groups(groups, workspace);
      break;
    case ToolId::stroke:
      options = {icon_named("stroke"), "Stroke", {}};
      add_parameter(groups, workspace, "smoothness");
      add_parameter(groups, workspace, "rigidity");
      reset();
      break;
    case ToolId::outline:
      options = {icon_named("outline"), "Outline", {}};
      add_parameter(groups, workspace, "softness");
      add_parameter(groups, workspace, "smoothness");
      groups.push_back(
          {"remove", [&workspace] { action_option("edit.remove_outline", "Remove", workspace); }});
      break;
    case ToolId::angle:
      options = {icon_named("angle"), "Angles", {}};
      add_angle_groups(groups, workspace);
      reset();
      break;
    case ToolId::attach:
      options = {icon_named("attach"), "Attach", {}};
      groups.push_back({"what", [] { inline_label("Click what the layer should follow"); }});
      groups.push_back(
          {"cancel", [&workspace] { action_option("tool.select", "Cancel", workspace); }});
      break;
    case ToolId::select:
      options = {icon_named("select"), "Select", {}};
      if (!selected_pins(workspace).empty()) {
        add_pin_groups(groups, workspace);
      } else if (selects_cage_points(workspace)) {
        add_cage_point_groups(groups, workspace);
      }
      groups.push_back(
          {"drags", [&workspace] {
             inline_label("Drag",
                          "What a drag of the picture moves: the layer under "
                          "the pointer, or nothing but points and pins");
             bool& layers = workspace.tools.drags_layers;
             if (const auto clicked = segmented("Drag", {"Layers", "Handles"}, layers ? 0 : 1))
               layers = *clicked == 0;
           }});
      add_drag_groups(groups, workspace);
      if (workspace.selection.empty())
        groups.push_back({"nothing", [] { inline_label("Nothing selected"); }});
      else
        reset();
      break;
  }
  return options;
}

/// Draws the groups from left to right, and the rest in a list.
void draw_groups(const OptionGroups& groups, float right) {
  ImGuiStorage& widths = *ImGui::GetStateStorage();
  const float separator = px(25), more = px(80);
  const auto id_of = [](const OptionGroup& group) { return ImGui::GetID(group.name); };
  const auto width_of = [&](const OptionGroup& group) {
    return widths.GetFloat(id_of(group), px(160));
  };
  float needed = 0;
  for (const OptionGroup& group : groups) needed += separator + width_of(group);
  const bool fits = ImGui::GetCursorScreenPos().x + needed <= right;
  size_t drawn = 0;
  for (; drawn < groups.size(); ++drawn) {
    const OptionGroup& group = groups[drawn];
    const float end = ImGui::GetCursorScreenPos().x + separator + width_of(group);
    if (!fits && end + more > right) break;
    bar_separator(px(28));
    ImGui::SameLine(0, 0);
    ImGui::BeginGroup();
    group.draw();
    ImGui::EndGroup();
    widths.SetFloat(id_of(group), ImGui::GetItemRectSize().x);
    ImGui::SameLine(0, 0);
  }
  if (drawn == groups.size()) return;
  bar_separator(px(28));
  ImGui::SameLine(0, 0);
  if (icon_button("More", icon_named("more"), "More options")) ImGui::OpenPopup("more options");
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(16), px(12)});
  if (ImGui::BeginPopup("more options")) {
    for (size_t i = drawn; i < groups.size(); ++i) {
      ImGui::BeginGroup();
      groups[i].draw();
      ImGui::EndGroup();
    }
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
}

}  // namespace

void draw_options_bar(Workspace& workspace, const PanelSizes& sizes) {
  const ThemeColors& c = theme_colors();
  const float right = ImGui::GetIO().DisplaySize.x - static_cast<float>(sizes.inspector),
              left = static_cast<float>(sizes.toolbar), top = static_cast<float>(sizes.menu),
              bottom = top + static_cast<float>(sizes.options);
  begin_panel("Options", {left, top}, {right, bottom}, c.chrome, {0, 0},
              ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({left, top}, {right, bottom}, faded(c.panel), px(8),
                     ImDrawFlags_RoundCornersTopLeft);
  list.AddLine({left, bottom - 1}, {right, bottom - 1}, faded(c.line));
  Options options = options_of(workspace);
  const float middle = (top + bottom) / 2;
  draw_icon(list, options.icon, {left + px(22), middle}, c.accent);
  draw_text(list, Type::strong, {left + px(38), middle - font(Type::strong)->FontSize / 2}, c.text,
            options.name);
  const float named = px(38) + text_size(Type::strong, options.name).x + px(4);
  ImGui::SetCursorScreenPos({left + named, std::round(middle - px(14))});
  const Layer& layer = workspace.document.scene().layer();
  ImGui::BeginDisabled((!layer.visible || layer.locked) && workspace.shown.timeline.keys.empty());
  ImGui::PushID(options.name.c_str());
  draw_groups(options.groups, right - px(12));
  ImGui::PopID();
  ImGui::EndDisabled();
  end_panel();
}

}  // namespace holomorph
