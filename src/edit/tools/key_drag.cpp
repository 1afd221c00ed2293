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
  committed_ = false;
}

TimeMap KeyDrag::map_to(double time) const {
  const auto [first, last] = span_of(keys_);
  if (kind_ == Kind::move || kind_ == Kind::copy) return {1, 0, std::max(time - start_, -first)};
  constexpr double kShortest = 1e-3;
  const double fixed = kind_ == Kind::stretch_start ? last : first,
               held = kind_ == Kind::stretch_start ? first : last;
  const double length = std::max(kShortest, last - first);
  const double wanted = held + (time - start_);
  const double factor = kind_ == Kind::stretch_start ? (fixed - std::max(wanted, 0.0)) / length
                                                     : (wanted - fixed) / length;
  return {std::max(factor, kShortest), fixed, fixed};
}

void KeyDrag::follow(Workspace& workspace, double time, bool freely) {
  if (!active_) return;
  if (workspace.document.scene().layers.size() != scene_.layers.size()) return end();
  TimeMap map = map_to(time);
  const bool moves = kind_ == Kind::move || kind_ == Kind::copy;
  if (moves && !freely) {
    // The keyframes keep their distances: the move itself is a whole number of frames.
    const double rate = scene_.animation.frames_per_second, first = span_of(keys_).first;
    map.to = std::max(std::round(map.to * rate) / rate, -first);
  }
  const bool stays = map.to == map.from && map.factor == 1;
  auto moved =
      stays ? std::optional(MovedKeys{scene_, keys_})
            : with_keys_moved(scene_, keys_, map,
                              {.to_frames = !moves && !freely, .copies = kind_ == Kind::copy});
  if (!moved || (!committed_ && moved->scene == scene_)) return;
  moved->scene.edited = workspace.document.scene().edited;
  const std::string label = !moves                ? "Stretch keyframes"
                            : kind_ == Kind::copy ? "Copy keyframes"
                            : keys_.size() == 1   ? "Move keyframe"
                                                  : "Move keyframes";
  const bool accepted = committed_ ? workspace.amend_layers(std::move(moved->scene))
                                   : workspace.commit_layers(label, std::move(moved->scene));
  if (!accepted) return;
  committed_ = true;
  workspace.shown.timeline.keys = std::move(moved->keys);
}

}  // namespace holomorph
