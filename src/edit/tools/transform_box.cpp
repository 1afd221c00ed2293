// Grips lie slightly outside the handles, so both can be picked.
#include "edit/tools/transform_box.h"

#include <algorithm>
#include <cmath>

#include "edit/edits/rest_edits.h"
#include "edit/tools/tool.h"

namespace holomorph {
namespace {

constexpr double kMargin = 1.8, kKnob = 2.6, kPick = 0.8;  // in multiples of the picking distance
constexpr int kKnobNumber = 8, kInside = 9;
constexpr double kLeastScale = 0.02;

/// The position of a grip on the box [-1, 1] x [-1, 1].
Complex direction_of(int grip) {
  constexpr std::array<std::array<int, 2>, 8> kDirections{
      {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};
  const auto& direction = kDirections[static_cast<size_t>(grip)];
  return {static_cast<double>(direction[0]), static_cast<double>(direction[1])};
}

double at_least(double scale) {
  return std::abs(scale) < kLeastScale ? std::copysign(kLeastScale, scale) : scale;
}

Box box_around(const Deformation& deformation, const Selection& selection, EditMode mode) {
  Box box;
  for (const Handle& handle : selection) {
    if (handle.kind != Handle::Kind::stroke)
      box.include(position_of(deformation, handle, mode));
    else
      for (const Complex& z : curve_of(deformation, handle.index, mode)) box.include(z);
  }
  return box;
}

}  // namespace

Affine Affine::scaling(double x, double y, Complex about) {
  Affine map{0.5 * (x + y), 0.5 * (x - y), 0};
  map.c = about - map(about);
  return map;
}

Affine Affine::turning(double angle, Complex about) {
  Affine map{std::polar(1.0, angle), 0, 0};
  map.c = about - map(about);
  return map;
}

namespace {

void transform(Deformation& deformation, const Selection& selection, const Affine& map, double turn,
               EditMode mode) {
  Selection all = selection;
  for (const Handle& handle : selection)
    for (const Handle& tangent : adjacent_tangents(cage_of(deformation, mode), handle))
      all.insert(tangent);
  const double size = std::sqrt(std::abs(std::norm(map.a) - std::norm(map.b)));
  for (const Handle& handle : all) {
    if (handle.kind == Handle::Kind::stroke) {
      Stroke& stroke = deformation.strokes[static_cast<size_t>(handle.index)];
      for (Complex& z : mode == EditMode::rest ? stroke.rest : stroke.pose) z = map(z);
      continue;
    }
    const Complex z = position_of(deformation, handle, mode);
    shift(deformation, handle, map(z) - z, mode);
    if (handle.kind != Handle::Kind::pin || mode == EditMode::rest) continue;
    Pin& pin = deformation.pins[static_cast<size_t>(handle.index)];
    if (!pin.angle) continue;
    *pin.angle += turn;
    pin.scale = std::clamp(size * pin.scale, kMinPinScale, kMaxPinScale);
  }
}

}  // namespace

Deformation transformed(Deformation deformation, const Selection& selection, const Affine& map,
                        double turn, EditMode mode) {
  return edited_in(mode, std::move(deformation),
                   [&](Deformation& edited) { transform(edited, selection, map, turn, mode); });
}

BoxMark TransformBox::mark_of(const Workspace& workspace, const Affine& map) const {
  const auto px = [&](Complex z) { return workspace.layer_view().px_at_plane(map(z)); };
  const Complex top(box_.center().real(), box_.top);
  return {{px({box_.left, box_.bottom}), px({box_.right, box_.bottom}), px({box_.right, box_.top}),
           px({box_.left, box_.top})},
          px(top + Complex(0, knob_)),
          {}};
}

void TransformBox::hover(const Input& input, const Workspace& workspace) {
  mark_.reset();
  inside_ = false;
  if (workspace.selection.size() < 2 || !workspace.display.show_cage ||
      workspace.display.hide_overlays)
    return;
  const double unit = workspace.display.handle_px / workspace.layer_view().zoom;
  content_ = box_around(workspace.shown.deformation(), workspace.selection, workspace.mode);
  const double margin = kMargin * unit;
  box_ = {content_.left - margin, content_.bottom - margin, content_.right + margin,
          content_.top + margin};
  knob_ = kKnob * unit;
  mark_ = mark_of(workspace, {});
  if (!input.inside) return;
  for (int grip = 0; grip <= kKnobNumber; ++grip)
    if (std::abs(mark_->grip(grip) - input.px) < kPick * workspace.display.handle_px)
      mark_->hovered = grip;
  inside_ = !mark_->hovered && box_.contains(input.position);
}

std::string TransformBox::hint() const {
  if (grip_ == kInside && active_) return "Hold Shift to move along one axis";
  if (inside_) return "Drag inside the box to move the selection; Shift-drag to select more";
  if (!mark_ || !mark_->hovered) return "";
  if (*mark_->hovered == kKnobNumber) return "Drag to rotate; hold Shift for steps of 15 degrees";
  return *mark_->hovered % 2 == 0
             ? "Drag to scale; hold Shift to scale freely, Alt to scale about the middle"
             : "Drag to scale in one direction; hold Alt to scale about the middle";
}

void TransformBox::start(const Input& input, const Workspace& workspace) {
  active_ = true;
  moving_ = false;
  grip_ = mark_->hovered.value_or(kInside);
  start_px_ = input.px;
  start_ = input.position;
  turn_ = 0;
  deformation_ = workspace.shown.deformation();
}

Affine TransformBox::map(const Input& input) {
  const Complex center = content_.center();
  if (grip_ == kInside) {
    const Complex by = input.position - start_;
    if (!input.mods.shift) return {1, 0, by};
    return {1, 0, std::abs(by.real()) > std::abs(by.imag()) ? by.real() : Complex(0, by.imag())};
  }
  if (grip_ == kKnobNumber) {
    const double angle = std::arg((input.position - center) * std::conj(start_ - center));
    turn_ = angle + 2 * kPi * std::round((turn_ - angle) / (2 * kPi));
    if (input.mods.shift) turn_ = std::round(turn_ / (kPi / 12)) * (kPi / 12);
    return Affine::turning(turn_, center);
  }
  // The opposite side of the handles' bounding box stays fixed. If that box is degenerate because
  // the handles lie on one line, the drawn box takes its place.
  const bool flat = std::min(content_.width(), content_.height()) < 1e-6 * box_.diagonal();
  const Box& scaled = flat ? box_ : content_;
  const Complex direction = direction_of(grip_), half(0.5 * scaled.width() * direction.real(),
                                                      0.5 * scaled.height() * direction.imag());
  const Complex about = input.mods.alt ? center : center - half, from = center + half - about,
                to = from + input.position - start_;
  if (direction.real() != 0 && direction.imag() != 0 && !input.mods.shift) {
    const double scale = at_least((to * std::conj(from)).real() / std::norm(from));
    return Affine::scaling(scale, scale, about);
  }
  return Affine::scaling(direction.real() != 0 ? at_least(to.real() / from.real()) : 1,
                         direction.imag() != 0 ? at_least(to.imag() / from.imag()) : 1, about);
}

void TransformBox::follow(const Input& input, Workspace& workspace) {
  moving_ = moving_ || std::abs(input.px - start_px_) >= kDragThresholdPx;
  if (moving_) {
    const Affine now = map(input);
    workspace.shown.preview =
        transformed(deformation_, workspace.selection, now, turn_, workspace.mode);
    mark_ = mark_of(workspace, now);
    if (grip_ != kInside) mark_->hovered = grip_;
  }
  if (input.down && !input.released) return;
  active_ = false;
  if (workspace.shown.preview)
    workspace.commit(grip_ == kKnobNumber ? "Rotate"
                     : grip_ == kInside   ? "Move"
                                          : "Scale",
                     *workspace.shown.preview);
  else if (grip_ == kInside)
    workspace.selection.clear();
}

void TransformBox::cancel(Workspace& workspace) {
  if (active_) workspace.shown.preview.reset();
  active_ = false;
  mark_.reset();
}

}  // namespace holomorph
