// A layer without a cage gets a box when it is moved.
#include "edit/tools/layer_drag.h"

#include "edit/edits/method_edits.h"
#include "edit/picking.h"
#include "edit/tools/tool.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

void move(Cage& cage, Complex by) {
  for (Points& segment : cage.segments)
    for (Complex& z : segment) z += by;
}

}  // namespace

Deformation moved_as_whole(Deformation deformation, Complex by) {
  move(deformation.pose, by);
  for (Pin& pin : deformation.pins) pin.pose += by;
  for (Stroke& stroke : deformation.strokes)
    for (Complex& z : stroke.pose) z += by;
  for (Complex& z : deformation.outline) z += by;
  for_fitting_keys(deformation, [&](Pose& pose) {
    move(pose.cage, by);
    for (PosePin& pin : pose.pins) pin.position += by;
    for (Points& stroke : pose.strokes)
      for (Complex& z : stroke) z += by;
  });
  return deformation;
}

Deformation with_box(Deformation deformation, const Image& picture) {
  const auto corners = picture.box().corners();
  return with_method_for(with_cage(std::move(deformation), {corners.begin(), corners.end()}),
                         MethodUse::cage);
}

bool shows_at(const Workspace& w, size_t number, Complex px) {
  const Layer& layer = *w.document.scene().layers[number];
  const Image* picture = w.document.pictures().of(layer);
  if (!layer.visible || layer.opacity == 0 || !picture) return false;
  const std::optional<Complex> rest = rest_in_layer(w, number, px);
  return rest && is_visible_at(*picture, *rest);
}

std::optional<size_t> layer_at(const Workspace& w, Complex px) {
  for (size_t i = w.document.scene().layers.size(); i-- > 0;)
    if (shows_at(w, i, px)) return i;
  return {};
}

void leave_closed_layer(Workspace& w, Complex px) {
  const Layer& layer = w.document.scene().layer();
  if (layer.visible && !layer.locked) return;
  if (const std::optional<size_t> there = layer_at(w, px)) w.choose_layer(*there);
}

bool LayerDrag::start(const Input& input, Workspace& w) {
  if (w.mode == EditMode::rest || w.display.view != View::image) return false;
  const std::optional<size_t> number = layer_at(w, input.px);
  if (!number) return false;
  w.choose_layer(*number);
  const Layer& layer = w.document.scene().layer();
  if (layer.locked || layer.deformation.surface) return false;
  const Image& picture = *w.document.image();
  const auto caged = [&](const Deformation& deformation) {
    return deformation.has_cage() ? deformation : with_box(deformation, picture);
  };
  shown_ = caged(w.shown.deformation());
  own_ = caged(w.shown.own());
  start_px_ = input.px;
  start_ = w.layer_view().plane_at_px(input.px);  // in the plane of the chosen layer
  active_ = true;
  moving_ = false;
  return true;
}

void LayerDrag::follow(const Input& input, Workspace& w) {
  moving_ = moving_ || std::abs(input.px - start_px_) >= kDragThresholdPx;
  Complex by = input.position - start_;
  if (input.mods.shift) by = w.layer_view().along_axis(by);
  if (moving_) w.shown.preview = moved_as_whole(shown_, by);
  if (!input.released && input.down) return;
  active_ = false;
  if (!moving_) {
    w.selection.clear();
    return;
  }
  w.shown.preview.reset();
  w.commit("Move layer", moved_as_whole(own_, by), EditBase::document);
}

void LayerDrag::cancel(Workspace& w) {
  if (active_) w.shown.preview.reset();
  active_ = false;
}

}  // namespace holomorph
