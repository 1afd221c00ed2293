// One sample for each frame; the needed ones are found as Ramer, Douglas and Peucker find the
// needed points of a line, with time in the place of length.
#include "edit/recording.h"

#include <algorithm>
#include <cmath>

namespace holomorph {

Points Recording::handles_in(const Scene& scene) const {
  Points places;
  for (const Handle& handle : what_) places.push_back(position_of(scene, handle, Layer::pose));
  return places;
}

void Recording::start(Workspace& workspace, Selection what, double now_ms) {
  what_ = std::move(what);
  start_ = workspace.unedited();
  over_keys_ = workspace.timed && workspace.timeline.shows;
  start_time_ = workspace.timeline.time;
  start_ms_ = now_ms;
  samples_ = {{start_time_, whole_pose_of(start_), handles_in(start_)}};
  workspace.timeline.playing = false;
  workspace.timeline.recording = true;
}

Scene Recording::follow(Workspace& workspace, Complex by, double now_ms) {
  const double time = std::min(kLongestTime, start_time_ + (now_ms - start_ms_) / 1000);
  Scene scene = start_;
  if (const Motion& motion = workspace.map.motion(); over_keys_ && motion.plays()) {
    scene = motion.scene_at(start_, time, motion.map_at(time));
    for (const Handle& handle : what_) {
      if (handle.kind == Handle::Kind::stroke)
        scene.strokes[static_cast<size_t>(handle.index)].pose =
            start_.strokes[static_cast<size_t>(handle.index)].pose;
      else if (exists(scene, handle, Layer::pose))
        scene =
            placed(std::move(scene), handle, position_of(start_, handle, Layer::pose), Layer::pose);
    }
  }
  scene = moved(std::move(scene), what_, by, Layer::pose);
  workspace.timeline.time = time;
  last_ = {time, whole_pose_of(scene), handles_in(scene)};
  const double frame = 1 / scene.animation.frames_per_second;
  if (time >= samples_.back().time + frame)
    samples_.push_back({frame * std::floor(time / frame), last_.pose, last_.handles});
  return scene;
}

std::vector<size_t> Recording::needed(double tolerance) const {
  std::vector<size_t> kept{0};
  const auto split = [&](const auto& self, size_t first, size_t last) -> void {
    size_t worst = first;
    double most = tolerance;
    for (size_t i = first + 1; i < last; ++i) {
      const Sample &a = samples_[first], &b = samples_[last], &here = samples_[i];
      const double share = (here.time - a.time) / (b.time - a.time);
      for (size_t h = 0; h < here.handles.size(); ++h) {
        const double off =
            std::abs(here.handles[h] - (1 - share) * a.handles[h] - share * b.handles[h]);
        if (off <= most) continue;
        worst = i;
        most = off;
      }
    }
    if (worst > first) {
      self(self, first, worst);
      self(self, worst, last);
    } else {
      kept.push_back(last);
    }
  };
  if (samples_.size() > 1) split(split, 0, samples_.size() - 1);
  return kept;
}

void Recording::finish(Workspace& workspace) {
  constexpr double kTolerancePx = 3;
  if (last_.time > samples_.back().time) {
    const double frame = 1 / start_.animation.frames_per_second;
    last_.time = std::min(kLongestTime, frame * std::ceil(last_.time / frame));
    samples_.push_back(std::move(last_));
  }
  const Scene before = workspace.document.scene();
  Scene scene = before;
  for (const Keyframe& key : before.keyframes) {
    const auto at = std::ranges::min_element(
        samples_, {}, [&](const Sample& sample) { return std::abs(sample.time - key.time); });
    if (key.time >= start_time_ && key.time <= samples_.back().time && fits(scene, key.pose))
      scene = with_key(posed_as(std::move(scene), at->pose), key.time);
  }
  for (const size_t i : needed(kTolerancePx / workspace.viewport.zoom))
    scene = with_key(posed_as(std::move(scene), samples_[i].pose), samples_[i].time);
  const double end = samples_.back().time;
  samples_.clear();
  workspace.timeline.recording = false;
  workspace.preview.reset();
  if (!workspace.commit("Record motion", posed_as(std::move(scene), whole_pose_of(before)))) {
    workspace.go_to_time(start_time_);
    return;
  }
  workspace.timeline.visible = true;
  workspace.go_to_time(end);
}

void Recording::cancel(Workspace& workspace) {
  if (!active()) return;
  samples_.clear();
  workspace.timeline.recording = false;
  workspace.timeline.time = start_time_;
}

std::string recording_hint(const Timeline& timeline) {
  char text[64];
  std::snprintf(text, sizeof text, "Recording, %.1f s; release to set the keys, Esc drops them",
                timeline.time);
  return text;
}

}  // namespace holomorph
