// Each field previews a change while it is dragged and commits one step when it is released.
#include "app/panels/selection_panel.h"

#include "app/panels/panels.h"
#include "edit/edits/corner_edits.h"
#include "edit/edits/curve_edits.h"
#include "edit/tools/transform_box.h"

namespace holomorph {
namespace {

/// A number field. Dragging it previews the change, and releasing it commits one step.
template <class Edit>
void edit_number(const char* label, double value, const char* format, float speed,
                 Workspace& workspace, const char* step, Edit edit) {
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  double number = value;
  const bool changed = ImGui::DragScalar(label, ImGuiDataType_Double, &number, speed, nullptr,
                                         nullptr, format, ImGuiSliderFlags_NoRoundToFormat);
  if (changed && std::isfinite(number))
    workspace.shown.preview = edit(workspace.shown.base(), number);
  if (ImGui::IsItemDeactivatedAfterEdit() && workspace.shown.preview)
    workspace.commit(step, *workspace.shown.preview);
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
  edit_number(
      "Next edge tension", pose.tension, "%.2f", 0.01f, workspace, "Tension",
      [&](const Deformation& s, double tension) { return with_tension(s, vertex, tension); });
}

/// Draws fields for a position. `moved_to` returns the deformation with the handles moved to a
/// point, and `position` returns where they are in a deformation.
template <class Position, class MovedTo>
void position_fields(Workspace& workspace, Position position, MovedTo moved_to) {
  const Complex z = position(workspace.shown.deformation());
  const float speed = static_cast<float>(1 / workspace.display.viewport.zoom);
  edit_number(
      "x", z.real(), "%.1f px", speed, workspace, "Move",
      [&](const Deformation& s, double x) { return moved_to(s, Complex(x, position(s).imag())); });
  edit_number(
      "y", z.imag(), "%.1f px", speed, workspace, "Move",
      [&](const Deformation& s, double y) { return moved_to(s, Complex(position(s).real(), y)); });
}

/// Draws the degree of a segment and, for a vertex, the fields of its corner.
void cage_point_fields(Workspace& workspace, Handle handle) {
  ImGui::Text("Curve degree %d",
              cage_of(workspace.shown.deformation(), workspace.mode).degree(handle.index));
  for (const char* id : {"cage.raise", "cage.lower"}) {
    ImGui::SameLine();
    if (ImGui::SmallButton(id == std::string("cage.raise") ? "+" : "-")) run(id, workspace);
  }
  if (handle.control == 0) corner_angles(workspace, handle.index);
}

void depth_field(Workspace& workspace, Index pin) {
  const Deformation& deformation = workspace.shown.deformation();
  int depth = deformation.pins[pin].depth;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (ImGui::InputInt("Depth", &depth)) {
    Deformation after = deformation;
    after.pins[pin].depth = std::clamp(depth, -kMaxDepth, kMaxDepth);
    workspace.commit_or_amend("Pin depth", std::move(after));
  }
  tooltip(
      "If parts of the picture overlap, the part near the pin with the greater depth is on top");
}

/// If the gap is visible, says how far short of the pin's target the picture stops.
void pin_gap(const Workspace& workspace, Index pin) {
  const Deformation& deformation = workspace.shown.deformation();
  const auto reached = workspace.map().pin_image(deformation, static_cast<size_t>(pin));
  if (!reached) return;
  const double gap = std::abs(*reached - deformation.pins[pin].pose);
  if (gap * workspace.display.viewport.zoom > 1)
    ImGui::TextWrapped(
        gap < 10 ? "The picture stops %.1f px short." : "The picture stops %.0f px short.", gap);
}

/// Draws the switch that fixes a pin's rotation and, if it is on, fields for rotation and scale.
void rotation_fields(Workspace& workspace, Index pin) {
  bool fixed = workspace.shown.deformation().pins[pin].angle.has_value();
  if (ImGui::Checkbox("Fix rotation", &fixed)) {
    Deformation after = workspace.shown.deformation();
    after.pins[pin].angle = fixed ? std::optional(0.0) : std::nullopt;
    workspace.commit(fixed ? "Fix rotation" : "Free rotation", after);
    return;
  }
  const Pin shown = workspace.shown.deformation().pins[pin];
  if (!shown.angle) return;
  edit_number(
      "Rotation", *shown.angle * 180 / kPi, "%.1f degrees", 0.5f, workspace, "Rotate pin",
      [&](const Deformation& s, double degrees) { return turned(s, pin, degrees * kPi / 180); });
  edit_number("Scale", 100 * shown.scale, "%.0f %%", 0.5f, workspace, "Scale pin",
              [&](const Deformation& s, double percent) {
                return scaled(s, pin, std::max(percent, 1.0) / 100 / s.pins[pin].scale);
              });
}

void one_handle(Workspace& workspace, Handle handle) {
  const EditMode mode = workspace.mode;
  const bool pin = handle.kind == Handle::Kind::pin;
  ImGui::Text("%s %d, %s",
              pin                                   ? "Pin"
              : handle.kind == Handle::Kind::stroke ? "Stroke"
              : handle.control > 0                  ? "Curve point of segment"
              : is_smooth(workspace.shown.deformation(), handle.index, mode) ? "Smooth cage point"
                                                                             : "Cage point",
              static_cast<int>(handle.index) + 1, mode == EditMode::rest ? "at rest" : "posed");
  position_fields(
      workspace, [&](const Deformation& s) { return position_of(s, handle, mode); },
      [&](const Deformation& s, Complex to) { return placed(s, handle, to, mode); });
  if (handle.kind == Handle::Kind::cage) cage_point_fields(workspace, handle);
  if (!pin) return;
  depth_field(workspace, handle.index);
  if (mode == EditMode::rest) return;
  pin_gap(workspace, handle.index);
  rotation_fields(workspace, handle.index);
}

void many_handles(Workspace& workspace) {
  const Selection selection = workspace.selection;
  const EditMode mode = workspace.mode;
  ImGui::Text("%d handles, centered at", static_cast<int>(selection.size()));
  const auto center = [&](const Deformation& s) { return center_of(s, selection, mode); };
  position_fields(workspace, center, [&](const Deformation& s, Complex to) {
    return moved(s, selection, to - center(s), mode);
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

}  // namespace

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

}  // namespace holomorph
