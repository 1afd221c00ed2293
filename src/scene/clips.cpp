// Times become numbers of frames with a tolerance, so that equal rates give equal numbers.
#include "scene/clips.h"

#include <algorithm>
#include <cmath>

namespace holomorph {

int first_played_frame(const Clip& clip) {
  return clip.frames > 0 ? std::min(clip.first, clip.frames - 1) : clip.first;
}

int last_played_frame(const Clip& clip) {
  const int first = first_played_frame(clip), end = std::max(clip.frames - 1, first);
  return std::clamp(clip.last.value_or(end), first, end);
}

int clip_frame_at(const Clip& clip, double time) {
  constexpr double kRounding = 1e-6;  // frames
  const int first = first_played_frame(clip);
  const double passed = std::floor((time - clip.start) * clip.frames_per_second + kRounding);
  const double count = last_played_frame(clip) - first + 1;
  const double played =
      clip.loops ? passed - count * std::floor(passed / count) : std::clamp(passed, 0.0, count - 1);
  return first + static_cast<int>(played);
}

double end_of(const Clip& clip) {
  const int frames = last_played_frame(clip) - first_played_frame(clip);
  double end = clip.start + frames / clip.frames_per_second;
  const double period = (frames + 1) / clip.frames_per_second;
  if (clip.loops && end <= 0) end += period * (std::floor(-end / period) + 1);
  return end;
}

const Clip* clip_of(const Layer& layer) {
  return layer.image && layer.image->clip ? &*layer.image->clip : nullptr;
}

bool has_clips(const Scene& scene) {
  return std::ranges::any_of(scene.layers,
                             [](const SharedLayer& layer) { return clip_of(*layer) != nullptr; });
}

}  // namespace holomorph
