// The gestures that several tools share.
#include "edit/tools/tool.h"
#include "edit/actions/actions.h"

#include "edit/edits/curve_edits.h"
#include "edit/picking.h"

namespace holomorph {

bool Tool::escape(Workspace& workspace) {
  if (!busy() && !selects()) return false;
  if (!busy()) workspace.selection.clear();
  cancel(workspace);
  return true;
}

bool HandleDrag::follow(const Input& input, Workspace& workspace) {
  if (!moving_ && std::abs(input.px - start_px_) >= kDragThresholdPx) {
    moving_ = true;
    const bool records = with_ctrl_ && !amends_ && workspace.mode == EditMode::pose;
    if (records && !recording_.start(workspace, what_, input.now_ms)) {
      active_ = false;
      return true;
    }
  }
  if (moving_) workspace.shown.preview = dragged(input, workspace);
  if (!input.released && input.down) return false;
  active_ = false;
  const bool vertex = pressed_.kind == Handle::Kind::cage && pressed_.control == 0;
  if (with_ctrl_ && !moving_ && !amends_ && vertex) {
    workspace.selection = {pressed_};
    toggle_corners(workspace);
  }
  finish(workspace);
  return true;
}

Deformation HandleDrag::dragged(const Input& input, Workspace& workspace) {
  Complex by = input.position - start_;
  if (input.mods.shift) by = workspace.layer_view().along_axis(by);
  if (recording_.active()) return recording_.follow(workspace, by, input.now_ms);
  guides_.clear();
  if (workspace.tools.snaps) {
    constexpr double kReach = 0.7;  // in multiples of the picking distance
    Snapping snapping{kReach * workspace.display.handle_px / workspace.layer_view().zoom, {}};
    if (const Image* image = workspace.document.image()) snapping.picture = image->page();
    by = snapped(deformation_, what_, pressed_, by, workspace.mode, snapping, guides_);
  }
  const Handle& first = *what_.begin();
  if (what_.size() == 1 && is_tangent(first))
    return tangent_moved(deformation_, first, position_of(deformation_, first, workspace.mode) + by,
                         workspace.mode, input.mods.alt);
  return displaced(deformation_,
                   displacements(deformation_, what_, by, workspace.mode, workspace.tools.drag),
                   workspace.mode);
}

void HandleDrag::finish(Workspace& workspace) {
  guides_.clear();
  if (recording_.active()) return recording_.finish(workspace);
  if (!workspace.shown.preview) return;
  if (amends_)
    workspace.amend(*workspace.shown.preview);
  else
    workspace.commit(workspace.mode == EditMode::rest ? "Move rest shape"
                     : kind_of(what_) == "point"      ? "Move"
                                                      : "Move " + kind_of(what_),
                     *workspace.shown.preview);
}

void toggle_corners(Workspace& workspace) {
  const Deformation after =
      toggled_corners(workspace.shown.deformation(), workspace.selection, workspace.mode);
  bool smooth = false;
  for (const Handle& handle : workspace.selection)
    smooth = smooth || (handle.kind == Handle::Kind::cage && handle.control == 0 &&
                        is_smooth(after, handle.index, workspace.mode));
  workspace.commit(smooth ? "Make smooth" : "Make corner", after);
}

bool erase_with_alt(const Input& input, Handle handle, Workspace& workspace) {
  if (!input.mods.alt || is_tangent(handle)) return false;
  workspace.erase({handle});
  return true;
}

namespace {

Complex center_px(const Workspace& workspace, Index pin) {
  return workspace.layer_view().px_at_plane(workspace.shown.deformation().pins[pin].pose);
}

}  // namespace

void PinRing::hover(const Input& input, const Workspace& workspace) {
  pin_.reset();
  hovered_ = false;
  if (workspace.mode != EditMode::pose || workspace.selection.size() != 1 ||
      !workspace.display.show_cage || workspace.display.hide_overlays)
    return;
  const Handle handle = *workspace.selection.begin();
  if (handle.kind != Handle::Kind::pin ||
      !exists(workspace.shown.deformation(), handle, EditMode::pose))
    return;
  pin_ = handle.index;
  const Deformation& deformation = workspace.shown.deformation();
  const auto near_circle = [&](double radius_px) {
    return input.inside &&
           std::abs(distance_to(input, workspace) - radius_px) < 0.6 * workspace.display.handle_px;
  };
  hovered_ = near_circle(kRingRadius * workspace.display.handle_px);
  const auto held = held_radius(deformation, *pin_, workspace.map().prepared());
  on_disk_ = !hovered_ && held && input.mods.ctrl &&
             near_circle(*held * deformation.pins[*pin_].scale * workspace.layer_view().zoom);
  hovered_ = hovered_ || on_disk_;
}

double PinRing::angle_to(const Input& input, const Workspace& workspace) const {
  return -std::arg(input.px - center_px(workspace, *pin_));
}

double PinRing::distance_to(const Input& input, const Workspace& workspace) const {
  return std::abs(input.px - center_px(workspace, *pin_));
}

void PinRing::start(const Input& input, const Workspace& workspace) {
  active_ = true;
  start_px_ = input.px;
  start_angle_ = angle_to(input, workspace);
  start_distance_ = distance_to(input, workspace);
  start_deformation_ = workspace.shown.deformation();
  start_rotation_ = rotation_at(workspace, *pin_);
  turned_ = 0;
  gesture_ = on_disk_ ? Gesture::resize : input.mods.ctrl ? Gesture::undecided : Gesture::rotate;
}

/// Once the pointer has moved with Ctrl, its direction decides between recording and resizing.
void PinRing::decide(const Input& input, Workspace& workspace) {
  constexpr double kDecisionPx = 2 * kDragThresholdPx;
  if (std::abs(input.px - start_px_) < kDecisionPx) return;
  const Complex from_pin = start_px_ - center_px(workspace, *pin_),
                way = (input.px - start_px_) / from_pin;
  const bool outward = std::abs(way.real()) > std::abs(way.imag());
  if (outward && held_radius(start_deformation_, *pin_, workspace.map().prepared()))
    gesture_ = Gesture::resize;
  else if (recording_.start(workspace, recorded_rotation(*pin_, start_rotation_), input.now_ms))
    gesture_ = Gesture::record;
  else
    cancel(workspace);
}

Deformation PinRing::rotated(const Input& input, const Workspace& workspace) const {
  double angle =
      start_rotation_ + std::remainder(angle_to(input, workspace) - start_angle_, 2 * kPi);
  // The angle is unwrapped from frame to frame, because a drag can exceed half a turn.
  const double last = workspace.shown.preview
                          ? workspace.shown.preview->pins[*pin_].angle.value_or(start_rotation_)
                          : start_rotation_;
  angle += 2 * kPi * std::round((last - angle) / (2 * kPi));
  if (input.mods.shift) angle = std::round(angle / (kPi / 12)) * (kPi / 12);
  return turned(start_deformation_, *pin_, angle);
}

Deformation PinRing::resized(const Input& input, const Workspace& workspace) const {
  const double px_per_radius = workspace.layer_view().zoom * start_deformation_.pins[*pin_].scale;
  const double by = (distance_to(input, workspace) - start_distance_) / px_per_radius;
  return with_held_radius(start_deformation_, *pin_,
                          *held_radius(start_deformation_, *pin_, workspace.map().prepared()) + by);
}

void PinRing::follow(const Input& input, Workspace& workspace) {
  if (gesture_ == Gesture::undecided) decide(input, workspace);
  if (!active_) return;
  const bool moved = workspace.shown.preview || std::abs(input.px - start_px_) >= kDragThresholdPx;
  if (gesture_ == Gesture::record) {
    turned_ += std::remainder(angle_to(input, workspace) - start_angle_ - turned_, 2 * kPi);
    workspace.shown.preview = recording_.follow(workspace, turned_, input.now_ms);
  } else if (moved && gesture_ == Gesture::resize) {
    workspace.shown.preview = resized(input, workspace);
  } else if (moved && gesture_ == Gesture::rotate) {
    workspace.shown.preview = rotated(input, workspace);
  }
  if (input.down && !input.released) return;
  active_ = false;
  if (gesture_ == Gesture::record) return recording_.finish(workspace);
  if (workspace.shown.preview)
    workspace.commit(gesture_ == Gesture::resize ? "Resize held disk" : "Rotate pin",
                     *workspace.shown.preview);
}

std::string PinRing::hint(const Workspace& workspace) const {
  if ((active_ && gesture_ == Gesture::resize) || (!active_ && on_disk_))
    return "Drag to change the radius of the disk that the pin holds";
  if (active_) return "Hold Shift for steps of 15 degrees";
  const bool holds =
      pin_ && held_radius(workspace.shown.deformation(), *pin_, workspace.map().prepared());
  return std::string(
             "Drag the ring to rotate the picture around the pin; scroll on it to scale; ") +
         (holds ? "Ctrl-drag around the pin to record, outward to change the disk it holds"
                : "Ctrl-drag it to record motion");
}

bool PinRing::scroll(const Input& input, Workspace& workspace) {
  hover(input, workspace);
  if (!hovered_) return false;
  const double factor = std::pow(1.05, input.wheel);
  const Deformation held =
      turned(workspace.shown.deformation(), *pin_, rotation_at(workspace, *pin_));
  workspace.commit_or_amend("Scale pin", scaled(held, *pin_, factor));
  return true;
}

void PinRing::cancel(Workspace& workspace) {
  if (active_) workspace.shown.preview.reset();
  if (recording_.active()) recording_.cancel(workspace);
  active_ = false;
}

std::string switched_to(MethodUse use) {
  return "Switched to " + usual_method(use).label + ".";
}

std::string needs_a_cage(const Workspace& workspace, const std::string& what) {
  return what + ". Draw one with " + workspace.actions.key_of("tool.pen") +
         ", or use Make from picture.";
}

}  // namespace holomorph
