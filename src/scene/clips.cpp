#include "scene/clips.h"

#include <algorithm>
#include <cmath>

namespace holomorph {

int last_played_frame(const Clip& clip) {
  const int end = std::max(clip.frames - 1, clip.first);
  return std::clamp(clip.last.value_or(end), clip.first, end);
}

int frame_at(const Clip& clip, double time) {
  constexpr double kRounding = 1e-6;  // frames
  const double passed = std::floor((time - clip.start) * clip.frames_per_second + kRounding);
  const double count = last_played_frame(clip) - clip.first + 1;
  const double played =
      clip.loops ? passed - count * std::floor(passed / count) : std::clamp(passed, 0.0, count - 1);
  return clip.first + static_cast<int>(played);
}

double end_of(const Clip& clip) {
  return clip.start + (last_played_frame(clip) - clip.first) / clip.frames_per_second;
}

Clip fitted(Clip clip, int frames) {
  clip.frames = frames;
  clip.first = std::clamp(clip.first, 0, std::max(0, frames - 1));
  if (clip.last && (*clip.last < clip.first || *clip.last >= frames)) clip.last.reset();
  return clip;
}

const Clip* clip_of(const Layer& layer) {
  return layer.image && layer.image->clip ? &*layer.image->clip : nullptr;
}

bool has_clips(const Scene& scene) {
  return std::ranges::any_of(scene.layers,
                             [](const SharedLayer& layer) { return clip_of(*layer) != nullptr; });
}

}  // namespace holomorph
