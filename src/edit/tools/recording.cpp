// Takes one sample per drawn frame. The Ramer-Douglas-Peucker algorithm, with time as the
// parameter, selects the samples that become keyframes.
#include "edit/tools/recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/motion.h"
#include "scene/prepared_map.h"

namespace holomorph {
namespace {

/// The positions of all handles. Rotations, scales and tensions are represented by points at a
/// distance of `reach`.
Points positions_in(const Pose& pose, double reach) {
  Points positions = vertices_of(pose.cage);
  for (const PosePin& pin : pose.pins) {
    positions.push_back(pin.position);
    positions.push_back(pin.position + std::polar(reach * pin.scale, pin.angle));
  }
  for (const PoseCorner& corner : pose.corners)
    positions.insert(positions.end(), {std::polar(reach, corner.before),
                                       std::polar(reach, corner.after), reach * corner.tension});
  for (const Points& stroke : pose.strokes)
    positions.insert(positions.end(), stroke.begin(), stroke.end());
  return positions;
}

void blend(Points& a, const Points& b, double fraction) {
  for (size_t i = 0; i < a.size() && a.size() == b.size(); ++i) a[i] += fraction * (b[i] - a[i]);
}

/// Interpolates between the poses of two samples that are one drawn frame apart.
Pose between(Pose a, const Pose& b, double fraction) {
  for (size_t e = 0; e < a.cage.segments.size(); ++e)
    blend(a.cage.segments[e], b.cage.segments[e], fraction);
  for (size_t k = 0; k < a.strokes.size(); ++k) blend(a.strokes[k], b.strokes[k], fraction);
  for (size_t p = 0; p < a.pins.size(); ++p) {
    PosePin& pin = a.pins[p];
    const PosePin& to = b.pins[p];
    pin.position += fraction * (to.position - pin.position);
    pin.angle += fraction * (to.angle - pin.angle);
    pin.scale *= std::pow(to.scale / pin.scale, fraction);
    if (pin.turn && to.turn) *pin.turn += fraction * (*to.turn - *pin.turn);
  }
  for (size_t c = 0; c < a.corners.size(); ++c) {
    PoseCorner& corner = a.corners[c];
    const PoseCorner& to = b.corners[c];
    corner.before += fraction * (to.before - corner.before);
    corner.after += fraction * (to.after - corner.after);
    corner.tension += fraction * (to.tension - corner.tension);
  }
  return a;
}

constexpr double kLongestStep = 0.4;  ///< seconds between keyframes while something moves

/// Whether a segment has the same degree in all keyframes that play.
bool keeps_degree(const Deformation& deformation, Index segment) {
  return std::ranges::all_of(deformation.keyframes, [&](const Keyframe& key) {
    return !fits(deformation, key.pose) ||
           key.pose.cage.degree(segment) == deformation.pose.degree(segment);
  });
}

}  // namespace

RecordedEdit recorded_rotation(Index pin, double from) {
  const auto angle_of = [pin, from](const Deformation& deformation) {
    return deformation.pins[static_cast<size_t>(pin)].angle.value_or(from);
  };
  return {[pin, angle_of](Deformation deformation) {
            const double angle = angle_of(deformation);
            return turned(std::move(deformation), pin, angle);
          },
          [pin, angle_of](Deformation deformation, const Deformation& start, Complex amount) {
            return turned(std::move(deformation), pin, angle_of(start) + amount.real());
          }};
}

namespace {

/// A deformation with handles at the positions to which they are dragged.
Deformation with_dragged(Deformation deformation, const Deformation& start, const Selection& what,
                         const DragOptions& options, Complex by) {
  const Displacements displacements_by_handle =
      displacements(start, what, by, EditMode::pose, options);
  // Moving a vertex moves its tangents, so tangents are placed after the vertices.
  for (const bool tangents : {false, true})
    for (const auto& [handle, way] : displacements_by_handle) {
      if (is_tangent(handle) != tangents || !exists(deformation, handle, EditMode::pose)) continue;
      if (handle.kind == Handle::Kind::stroke) {
        Points& pose = deformation.strokes[static_cast<size_t>(handle.index)].pose;
        pose = curve_of(start, handle.index, EditMode::pose);
        for (Complex& z : pose) z += way;
      } else {
        deformation = placed(std::move(deformation), handle,
                             position_of(start, handle, EditMode::pose) + way, EditMode::pose);
      }
    }
  return deformation;
}

}  // namespace

/// Finds whether keyframes play, and whether there is time left.
bool Recording::begin(Workspace& workspace, double now_ms) {
  if (!workspace.require_pose()) return false;
  start_ = workspace.shown.base();
  if (!workspace.require_keyframe_maps()) return false;
  keyframes_play_ = !start_.keyframes.empty() && workspace.map().motion().plays();
  start_time_ = workspace.shown.timeline.time;
  start_ms_ = now_ms;
  if (start_time_ < kMaxTime) return true;
  workspace.messages.say("No time left to record. Go to an earlier time.");
  return false;
}

bool Recording::start(Workspace& workspace, RecordedEdit edit, double now_ms) {
  if (!begin(workspace, now_ms)) return false;
  const Deformation before = start_;
  start_ = edit.prepare(std::move(start_));
  // Other handles at rest need other maps, and those at the keyframes would be lost meanwhile.
  if (keyframes_play_ && (!fits(start_, whole_pose_of(before)) || !same_rest(start_, before))) {
    workspace.messages.say(
        "Not recorded: at the keyframes, this cannot turn yet. Drag it once without Ctrl, and try "
        "again.");
    return false;
  }
  edit_ = std::move(edit);
  turn_reach_ = kRingRadius * workspace.display.handle_px / workspace.layer_view().zoom;
  const Pose pose = whole_pose_of(dragged(base_at(workspace, start_time_), 0));
  samples_ = {{start_time_, 0, pose, positions_in(pose, turn_reach_)}};
  workspace.shown.timeline.playing = false;
  workspace.shown.timeline.recording = true;
  return true;
}

bool Recording::start(Workspace& workspace, const Selection& what, double now_ms) {
  if (!begin(workspace, now_ms)) return false;
  Selection kept = what;
  std::erase_if(kept, [&](const Handle& handle) {
    return !exists(start_, handle, EditMode::pose) ||
           (keyframes_play_ && is_tangent(handle) && !keeps_degree(start_, handle.index));
  });
  if (kept.empty()) {
    workspace.messages.say("Not recorded: these tangents do not exist in all keyframes.");
    return false;
  }
  const DragOptions options = workspace.tools.drag;
  return start(workspace,
               {[](Deformation deformation) { return deformation; },
                [kept, options](Deformation deformation, const Deformation& from, Complex by) {
                  return with_dragged(std::move(deformation), from, kept, options, by);
                }},
               now_ms);
}

Deformation Recording::base_at(Workspace& workspace, double time) const {
  Motion& motion = workspace.map().motion();
  return keyframes_play_ && motion.plays()
             ? motion.deformation_at(start_, time, motion.map_at(time))
             : start_;
}

Deformation Recording::follow(Workspace& workspace, Complex by, double now_ms) {
  const double time = std::min(kMaxTime, start_time_ + (now_ms - start_ms_) / 1000);
  Deformation deformation = dragged(base_at(workspace, time), by);
  workspace.shown.timeline.time = time;
  const Pose pose = whole_pose_of(workspace.with_turns(deformation));
  if (time > samples_.back().time) samples_.emplace_back();
  samples_.back() = {time, by, pose, positions_in(pose, turn_reach_)};
  return deformation;
}

Recording::RecordedPose Recording::sample_at(double time) const {
  const auto after = std::ranges::lower_bound(samples_, time, {}, &RecordedPose::time);
  if (after == samples_.end()) return samples_.back();
  if (after == samples_.begin()) return samples_.front();
  const RecordedPose &a = *std::prev(after), &b = *after;
  const double fraction = (time - a.time) / (b.time - a.time);
  return {time, a.by + fraction * (b.by - a.by), between(a.pose, b.pose, fraction), {}};
}

/// The times of the samples that become keyframes.
std::vector<double> Recording::keyframe_times(double tolerance) const {
  std::vector<double> times{samples_.front().time};
  const auto split = [&](const auto& self, size_t first, size_t last) -> void {
    const RecordedPose &a = samples_[first], &b = samples_[last];
    size_t worst = first;
    double most = tolerance;
    for (size_t i = first + 1; i < last; ++i) {
      const double fraction = (samples_[i].time - a.time) / (b.time - a.time);
      for (size_t h = 0; h < a.positions.size(); ++h) {
        const double off = std::abs(samples_[i].positions[h] - (1 - fraction) * a.positions[h] -
                                    fraction * b.positions[h]);
        if (off <= most) continue;
        worst = i;
        most = off;
      }
    }
    // Between keyframes, parts may rotate instead of moving along straight lines. Over short
    // distances the difference is negligible, so long steps are split.
    double way = 0;
    for (size_t h = 0; h < a.positions.size(); ++h)
      way = std::max(way, std::abs(b.positions[h] - a.positions[h]));
    if (worst == first && last > first + 1 && b.time - a.time > kLongestStep && way > tolerance)
      worst = (first + last) / 2;
    if (worst > first) {
      self(self, first, worst);
      self(self, worst, last);
    } else {
      times.push_back(b.time);
    }
  };
  split(split, 0, samples_.size() - 1);
  return times;
}

void Recording::finish(Workspace& workspace) {
  constexpr double kTolerancePx = 3;
  const Scene& scene = workspace.document.scene();
  const Deformation before = edit_.prepare(scene.deformation());
  const auto at_frame = [&](double time) { return time_of_frame(scene, frame_at(scene, time)); };
  const double end = samples_.back().time;
  if (at_frame(end) <= start_time_) return cancel(workspace);
  double tolerance = kTolerancePx / workspace.layer_view().zoom;
  std::vector<double> times = keyframe_times(tolerance);
  while (times.size() + before.keyframes.size() > kMaxKeyframes && times.size() > 2)
    times = keyframe_times(tolerance *= 2);
  Deformation deformation = before;
  const auto set = [&](double time, const Pose& pose) {
    const size_t there = key_at(deformation, time);
    if (there < deformation.keyframes.size() &&
        !fits(deformation, deformation.keyframes[there].pose))
      return;
    deformation = with_key(posed_as(std::move(deformation), pose), time);
  };
  for (const double time : times) {
    const double at = time == start_time_ ? time : at_frame(time);
    if (key_at(before, at) == before.keyframes.size()) set(at, sample_at(at).pose);
  }
  for (const Keyframe& key : before.keyframes)
    if (key.time >= start_time_ && key.time <= end && fits(before, key.pose))
      set(key.time, whole_pose_of(dragged(posed_as(before, key.pose), sample_at(key.time).by)));
  // The easing is linear between the recorded keyframes. After the last one, it stays what it was
  // before.
  const auto behind = std::ranges::upper_bound(before.keyframes, end, {}, &Keyframe::time);
  const Ease last = behind == before.keyframes.begin() ? Ease::smooth : std::prev(behind)->ease;
  const double last_time = at_frame(end);
  for (Keyframe& key : deformation.keyframes)
    if (key.time >= start_time_ && key.time <= last_time && fits(deformation, key.pose))
      key.ease = key.time < last_time ? Ease::linear : last;
  preserve_turns(deformation, before, workspace.map().motion());
  samples_.clear();
  workspace.shown.timeline.recording = false;
  if (!workspace.commit("Record motion", posed_as(std::move(deformation), whole_pose_of(before)),
                        EditBase::document)) {
    workspace.shown.timeline.time = start_time_;
    return;
  }
  workspace.shown.timeline.visible = true;
  workspace.go_to_time(last_time);
}

void Recording::cancel(Workspace& workspace) {
  samples_.clear();
  workspace.shown.preview.reset();
  // If another document was opened, `recording` is off and the time of that document is kept.
  if (std::exchange(workspace.shown.timeline.recording, false))
    workspace.shown.timeline.time = start_time_;
}

std::string recording_hint(const Timeline& timeline) {
  char text[80];
  std::snprintf(text, sizeof text, "Recording, %.1f s; release to set the keyframes, Esc cancels",
                timeline.time);
  return text;
}

}  // namespace holomorph
