// Times are in seconds. Steps and snapping use whole frames.
#include "edit/timeline.h"

#include <cmath>

namespace holomorph {

bool advance(Timeline& timeline, const Scene& scene, double now_ms) {
  if (!timeline.playing) return false;
  const double length = length_of(scene), period = period_of(scene);
  if (!plays(scene)) {
    timeline.playing = false;
    return false;
  }
  const double step = timeline.clock_ms ? (now_ms - *timeline.clock_ms) / 1000 : 0;
  timeline.clock_ms = now_ms;
  timeline.active = true;
  timeline.time += step;
  if (timeline.time <= (timeline.loop ? period : length)) return true;
  if (timeline.loop) {
    timeline.time = std::fmod(timeline.time, period);
  } else {
    timeline.time = length;
    timeline.playing = false;
  }
  return true;
}

int frame_at(const Scene& scene, double time) {
  return static_cast<int>(std::lround(time * scene.animation.frames_per_second));
}

double time_of_frame(const Scene& scene, int frame) {
  return std::clamp(frame / scene.animation.frames_per_second, 0.0, kMaxTime);
}

std::optional<double> next_key(const Deformation& deformation, double time, bool forwards) {
  constexpr double kHere = 1e-3;
  std::optional<double> next;
  for (const Keyframe& key : deformation.keyframes) {
    if (forwards && key.time > time + kHere && !next) next = key.time;
    if (!forwards && key.time < time - kHere) next = key.time;
  }
  return next;
}

}  // namespace holomorph
