// Every position of the drag is computed from the scene at its start, so keyframes can pass others.
#include "edit/tools/key_drag.h"

#include <algorithm>
#include <cmath>

namespace holomorph {

void KeyDrag::start(const Workspace& workspace, Kind kind, double time) {
  kind_ = kind;
  start_ = time;
  scene_ = workspace.document.scene();
  keys_ = editable_keys(scene_, workspace.shown.timeline.keys);
  active_ = !keys_.empty();
  moving_ = false;
}

TimeMap KeyDrag::map_to(double time) const {
  const auto [first, last] = span_of(keys_);
  if (kind_ == Kind::move) return {1, 0, std::max(time - start_, -first)};
  constexpr double kShortest = 1e-3;
  const double fixed = kind_ == Kind::stretch_start ? last : first,
               held = kind_ == Kind::stretch_start ? first : last;
  const double length = std::max(kShortest, last - first);
  const double wanted = held + (time - start_);
  const double factor = kind_ == Kind::stretch_start ? (fixed - std::max(wanted, 0.0)) / length
                                                     : (wanted - fixed) / length;
  return {std::max(factor, kShortest), fixed, fixed};
}

void KeyDrag::follow(Workspace& workspace, double time, bool freely, bool copies) {
  if (!active_) return;
  if (workspace.document.scene().layers.size() != scene_.layers.size()) return end(workspace);
  TimeMap map = map_to(time);
  if (kind_ == Kind::move && !freely) {
    // The keyframes keep their distances: the move itself is a whole number of frames.
    const double rate = scene_.animation.frames_per_second;
    map.to = std::round(map.to * rate) / rate;
    if (span_of(keys_).first + map.to < 0) map.to = -span_of(keys_).first;
  }
  const bool stays = map.to == 0 && map.factor == 1;
  if (stays && !moving_) return;
  const bool to_frames = kind_ != Kind::move && !freely;
  auto moved = stays && !copies ? std::optional(MovedKeys{scene_, keys_})
                                : with_keys_moved(scene_, keys_, map, to_frames, copies);
  if (!moved) return;
  const std::string label = kind_ != Kind::move ? "Stretch keyframes"
                            : copies            ? "Copy keyframes"
                            : keys_.size() == 1 ? "Move keyframe"
                                                : "Move keyframes";
  if (!moving_) workspace.end_mergeable_step();
  moving_ = true;
  Scene scene = std::move(moved->scene);
  scene.edited = workspace.document.scene().edited;
  workspace.commit_or_amend_layers(label, std::move(scene));
  workspace.shown.timeline.keys = std::move(moved->keys);
}

void KeyDrag::end(Workspace& workspace) {
  if (moving_) workspace.end_mergeable_step();
  active_ = moving_ = false;
  scene_ = {};
}

}  // namespace holomorph
