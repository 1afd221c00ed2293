// Each field previews a change while it is dragged and commits one step when it is released.
#include "app/panels/selection_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/look/controls.h"
#include "app/panels/edit_value.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/edits/method_edits.h"
#include "edit/picking.h"
#include "edit/tools/transform_box.h"

namespace holomorph {
namespace {

constexpr double kDegree = kPi / 180;

/// Draws the two coordinates of a position. `moved_to` returns the deformation with the handles
/// moved to a point, and `position` returns where they are in a deformation.
template <class Position, class MovedTo>
void position_row(Workspace& workspace, Position position, MovedTo moved_to) {
  const Complex z = position(workspace.shown.deformation());
  const double zoom = workspace.layer_view().zoom;
  Number number{.unit = "px", .decimals = 0, .speed = 1 / zoom};
  if (std::abs(z.real()) < 10 || std::abs(z.imag()) < 10) number.decimals = 1;
  row_label("Position");
  const float gap = px(8), width = std::floor((ImGui::GetContentRegionAvail().x - gap) / 2);
  double x = z.real(), y = z.imag();
  const Change along_x = number_field("##x", x, number, width, "X");
  ImGui::SameLine(0, gap);
  const Change along_y = number_field("##y", y, number, width, "Y");
  apply_change(workspace, along_x, "Move",
               [&](const Deformation& s) { return moved_to(s, Complex(x, position(s).imag())); });
  apply_change(workspace, along_y, "Move",
               [&](const Deformation& s) { return moved_to(s, Complex(position(s).real(), y)); });
}

/// Draws the angles of a corner and the tension of the edge after it.
void corner_rows(Workspace& workspace, Index vertex) {
  const Deformation deformation = workspace.shown.deformation();
  if (!has_method_for(deformation, MethodUse::corners) || workspace.mode == EditMode::rest) return;
  if (!is_corner(deformation, vertex)) return muted_text("Not a corner. Click it with Angles.");
  const PoseCorner pose = corner_at(deformation, vertex);
  double turn = (pose.before + pose.after) / 2 / kDegree,
         opening = corner_opening(deformation, vertex) / kDegree, tension = 100 * pose.tension;
  const Number angle{.low = -720, .high = 720, .unit = "\u00b0", .neutral = 0.0};
  apply_change(workspace, slider_row("Turn", turn, angle), "Turn corner",
               [&](const Deformation& s) {
                 const PoseCorner now = corner_at(s, vertex);
                 return corner_turned(s, vertex, turn * kDegree - (now.before + now.after) / 2);
               });
  apply_change(
      workspace, slider_row("Opening", opening, angle), "Open corner", [&](const Deformation& s) {
        return corner_opened(s, vertex, (opening * kDegree - corner_opening(s, vertex)) / 2);
      });
  apply_change(
      workspace,
      slider_row("Tension", tension, {.low = 0, .high = 100, .unit = "%", .neutral = 100.0},
                 "How straight the next edge is"),
      "Tension", [&](const Deformation& s) { return with_tension(s, vertex, tension / 100); });
}

/// Whether pins give way where they would stretch the picture too far.
bool has_stretch_limit(const Deformation& deformation) {
  const Method& method = chosen_method(deformation);
  const auto spec = std::ranges::find(method.parameters, "stretch_limit", &ParameterSpec::key);
  return spec != method.parameters.end() && is_used(method, chosen_parameters(deformation), *spec);
}

/// By how many degrees the picture turns less than a pin asks for, where it is held back visibly.
std::optional<double> angle_gap(const LiveMap& map, const Deformation& deformation, Index pin) {
  constexpr double kVisible = 2;  // degrees
  const auto& angle = deformation.pins[pin].angle;
  const auto turn = map.pin_turn(deformation, static_cast<size_t>(pin));
  if (!angle || !turn || map.map().turns.empty()) return {};
  const double gap = std::abs(*angle - *turn) / kDegree;
  return gap > kVisible ? std::optional(gap) : std::nullopt;
}

/// If the gap is visible, says how far short of the pin's target the picture stops.
void pin_gap(const Workspace& workspace, Index pin) {
  const Deformation& deformation = workspace.shown.deformation();
  const auto reached = workspace.map().pin_image(deformation, static_cast<size_t>(pin));
  if (!reached) return;
  double gap = std::abs(*reached - deformation.pins[pin].pose);
  const char* unit = " px";
  if (gap * workspace.layer_view().zoom <= 1) {
    const auto angle = angle_gap(workspace.map(), deformation, pin);
    if (!angle) return;
    gap = *angle;
    unit = "\u00b0";
  }
  const bool limited = has_stretch_limit(deformation);
  char text[80];
  std::snprintf(text, sizeof text, "%s %.*f%s short%s", limited ? "Stops" : "The picture stops",
                gap < 10 ? 1 : 0, gap, unit, limited ? ", at the stretch limit." : ".");
  colored_text(theme_colors().warning, text);
  if (limited)
    tooltip(
        "The pin gives way rather than stretch the picture farther. If you want more, raise "
        "Stretch limit in the method's settings.");
}

void pin_rows(Workspace& workspace, Index pin) {
  if (workspace.mode == EditMode::rest) return;
  const Pin shown = workspace.shown.deformation().pins[pin];
  ImGui::BeginDisabled(!shown.angle);
  double degrees = rotation_at(workspace, pin) / kDegree,
         percent = shown.angle ? 100 * shown.scale : 100;
  apply_change(
      workspace,
      slider_row("Rotation", degrees,
                 {.low = -180, .high = 180, .unit = "\u00b0", .neutral = 0.0, .typed = 3600},
                 shown.angle ? "" : "Set Rotation to Fixed to use this"),
      "Rotate pin", [&](const Deformation& s) { return turned(s, pin, degrees * kDegree); });
  apply_change(
      workspace,
      slider_row("Scale", percent,
                 {.low = 10, .high = 1000, .unit = "%", .logarithmic = true, .neutral = 100.0}),
      "Scale pin", [&](const Deformation& s) {
        return scaled(s, pin, std::max(percent, 1.0) / 100 / s.pins[pin].scale);
      });
  ImGui::EndDisabled();
  const auto held = held_radius(workspace.shown.deformation(), pin, workspace.map().prepared());
  ImGui::BeginDisabled(!held);
  double radius = held.value_or(0);
  apply_change(
      workspace,
      slider_row(
          "Hold radius", radius,
          {.low = 1,
           .high = std::max(
               500.0, box_of(outline_of(workspace.shown.deformation().rest).points).diagonal()),
           .unit = "px",
           .logarithmic = true},
          "The disk that keeps its shape around a pin with fixed rotation, in methods that "
          "keep sizes"),
      "Resize held disk", [&](const Deformation& s) { return with_held_radius(s, pin, radius); });
  ImGui::EndDisabled();
  pin_gap(workspace, pin);
}

/// A slider for relative changes. After each change, it returns to `neutral` (0 or 100 %).
template <class Edit>
void step_row(const char* label, const Number& number, Workspace& workspace, const char* step,
              Edit edit) {
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(label);
  const double neutral = *number.neutral;
  double value = static_cast<double>(storage.GetFloat(id, static_cast<float>(neutral)));
  const Change change = slider_row(label, value, number);
  apply_change(workspace, change, step, [&](const Deformation& s) { return edit(s, value); });
  const bool active = workspace.shown.preview.has_value() && ImGui::IsAnyItemActive();
  storage.SetFloat(
      id, static_cast<float>((change.changed || active) && !change.ended ? value : neutral));
}

/// Draws sliders that rotate and scale the selection about its center.
void turn_and_scale(Workspace& workspace) {
  const Selection selection = workspace.selection;
  const EditMode mode = workspace.mode;
  step_row("Rotate by", {.low = -180, .high = 180, .unit = "\u00b0", .neutral = 0.0}, workspace,
           "Rotate", [&](const Deformation& s, double degrees) {
             const double angle = degrees * kDegree;
             return transformed(s, selection, Affine::turning(angle, center_of(s, selection, mode)),
                                angle, mode);
           });
  step_row(
      "Scale by", {.low = 10, .high = 1000, .unit = "%", .logarithmic = true, .neutral = 100.0},
      workspace, "Scale", [&](const Deformation& s, double percent) {
        const double scale = std::max(percent, 1.0) / 100;
        return transformed(s, selection,
                           Affine::scaling(scale, scale, center_of(s, selection, mode)), 0, mode);
      });
}

void one_handle(Workspace& workspace, Handle handle) {
  const EditMode mode = workspace.mode;
  position_row(
      workspace, [&](const Deformation& s) { return position_of(s, handle, mode); },
      [&](const Deformation& s, Complex to) { return placed(s, handle, to, mode); });
  if (handle.kind == Handle::Kind::pin) return pin_rows(workspace, handle.index);
  if (handle.kind == Handle::Kind::stroke) return turn_and_scale(workspace);
  if (handle.control == 0) corner_rows(workspace, handle.index);
}

void many_handles(Workspace& workspace) {
  const Selection selection = workspace.selection;
  const EditMode mode = workspace.mode;
  const auto center = [&](const Deformation& s) { return center_of(s, selection, mode); };
  position_row(workspace, center, [&](const Deformation& s, Complex to) {
    return moved(s, selection, to - center(s), mode);
  });
  turn_and_scale(workspace);
}

/// Moves the selected keyframes as one step, if nothing is in their way.
void move_keys(Workspace& workspace, const Change& change, const char* step, const TimeMap& map) {
  if (change.changed) {
    auto moved = with_keys_moved(workspace.document.scene(), workspace.shown.timeline.keys, map);
    if (moved && workspace.commit_or_amend_layers(step, std::move(moved->scene)))
      workspace.shown.timeline.keys = std::move(moved->keys);
  }
  if (change.ended) workspace.end_mergeable_step();
}

/// When the selected keyframes start, how long they take, and the whole turns before a single one.
void key_rows(Workspace& workspace) {
  const KeySelection keys = workspace.shown.timeline.keys;
  const auto [first, last] = span_of(keys);
  const double longest = std::max(2.0, 1.5 * length_of(workspace.document.scene()));
  double start = first, length = last - first;
  const Change moves =
      slider_row("Start", start, {.low = 0, .high = longest, .unit = "s", .decimals = 2});
  move_keys(workspace, moves, "Move keyframes", {1, first, std::max(start, 0.0)});
  ImGui::BeginDisabled(first == last);
  const Change stretches =
      slider_row("Length", length, {.low = 0, .high = longest, .unit = "s", .decimals = 2});
  if (first < last)
    move_keys(workspace, stretches, "Stretch keyframes",
              {std::max(length, 1e-2) / (last - first), first, first});
  ImGui::EndDisabled();
  const Deformation own = workspace.shown.own();
  const size_t key = key_at(own, first);
  const bool single = keys.size() == 1 && key > 0 && key < own.keyframes.size() &&
                      keys.begin()->layer == workspace.document.scene().layer().id;
  double turns = single ? own.keyframes[key].turns : 0;
  ImGui::BeginDisabled(!single);
  const Change turned = slider_row("Whole turns", turns, {.low = -10, .high = 10, .neutral = 0.0},
                                   "Extra whole turns between the previous keyframe and this one");
  if (turned.changed && single) {
    Deformation after = own;
    after.keyframes[key].turns =
        std::clamp(static_cast<int>(std::lround(turns)), -kMaxTurns, kMaxTurns);
    workspace.commit_or_amend("Whole turns", after, EditBase::document);
    workspace.shown.timeline.keys = keys;
  }
  if (turned.ended) workspace.end_mergeable_step();
  ImGui::EndDisabled();
}

}  // namespace

std::string selection_title(const Workspace& workspace) {
  const Selection& selection = workspace.selection;
  if (const size_t keys = workspace.shown.timeline.keys.size(); keys > 0)
    return keys == 1 ? "Keyframe" : std::to_string(keys) + " keyframes";
  if (selection.empty()) return "Selection";
  std::string kind = kind_of(selection);
  if (selection.size() > 1) return std::to_string(selection.size()) + " " + kind + "s";
  const Handle& handle = *selection.begin();
  if (is_tangent(handle)) kind = "tangent";
  kind[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(kind[0])));
  return kind + " " + std::to_string(handle.index + 1);
}

void selection_section(Workspace& workspace) {
  const ImVec2 at = ImGui::GetCursorPos();
  const float height = 4 * px(36) + px(24);  // four rows and a note
  if (!workspace.shown.timeline.keys.empty()) {
    key_rows(workspace);
  } else if (workspace.selection.empty()) {
    caption(workspace.shown.deformation().has_cage()
                ? "Nothing is selected. Click a point, a pin or a stroke, or drag a box around "
                  "some of them."
                : "Nothing is selected.");
  } else if (workspace.selection.size() == 1) {
    one_handle(workspace, *workspace.selection.begin());
  } else {
    many_handles(workspace);
  }
  ImGui::SetCursorPos({at.x, at.y + height});
}

}  // namespace holomorph
