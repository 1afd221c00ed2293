// Times become numbers of frames with a tolerance, so that equal rates give equal numbers.
#include "scene/clips.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

constexpr double kRounding = 1e-6;  // frames

}  // namespace

int first_played_frame(const Clip& clip) {
  return clip.frames > 0 ? std::min(clip.first, clip.frames - 1) : clip.first;
}

int last_played_frame(const Clip& clip) {
  const int first = first_played_frame(clip), end = std::max(clip.frames - 1, first);
  return std::clamp(clip.last.value_or(end), first, end);
}

int played_frames(const Clip& clip) {
  return last_played_frame(clip) - first_played_frame(clip) + 1;
}

double duration_of(const Clip& clip) {
  return played_frames(clip) / clip.frames_per_second;
}

int clip_frame_at(const Clip& clip, double time) {
  const double passed = std::floor((time - clip.start) * clip.frames_per_second + kRounding);
  const double count = played_frames(clip);
  const double played =
      clip.loops ? passed - count * std::floor(passed / count) : std::clamp(passed, 0.0, count - 1);
  return first_played_frame(clip) + static_cast<int>(played);
}

double end_of(const Clip& clip) {
  const double period = duration_of(clip);
  double end = clip.start + period - 1 / clip.frames_per_second;
  if (clip.loops && end <= 0) end += period * (std::floor(-end / period) + 1);
  return end;
}

double last_moment_of(const Clip& clip, double frames_per_second) {
  const double end = end_of(clip), shown_until = end + 1 / clip.frames_per_second;
  const double frame = std::ceil(shown_until * frames_per_second - kRounding) - 1;
  return std::max(end, frame / frames_per_second);
}

const Clip* clip_of(const Layer& layer) {
  return layer.image && layer.image->clip ? &*layer.image->clip : nullptr;
}

bool has_clips(const Scene& scene) {
  return std::ranges::any_of(scene.layers,
                             [](const SharedLayer& layer) { return clip_of(*layer) != nullptr; });
}

}  // namespace holomorph
