// Keyframes are sorted by time, and no two have the same time.
#include "scene/keyframes.h"

#include <algorithm>

#include "core/error.h"
#include "scene/clips.h"

namespace holomorph {

size_t key_at(const Deformation& deformation, double time) {
  const auto found = std::ranges::find_if(deformation.keyframes, [&](const Keyframe& key) {
    return std::abs(key.time - time) < kSameTime;
  });
  return static_cast<size_t>(found - deformation.keyframes.begin());
}

Deformation with_key(Deformation deformation, double time) {
  const size_t there = key_at(deformation, time);
  Pose pose = whole_pose_of(deformation);
  if (there < deformation.keyframes.size()) {
    Keyframe& key = deformation.keyframes[there];
    if (!fits(deformation, key.pose)) key.pose_extra.clear();
    key.pose = std::move(pose);
    return deformation;
  }
  const auto next = std::ranges::upper_bound(deformation.keyframes, time, {}, &Keyframe::time);
  const Ease ease = next == deformation.keyframes.begin() ? Ease::smooth : std::prev(next)->ease;
  deformation.keyframes.insert(next, {time, std::move(pose), ease});
  return deformation;
}

Deformation without_key(Deformation deformation, size_t key) {
  deformation.keyframes.erase(deformation.keyframes.begin() + static_cast<long>(key));
  return deformation;
}

std::vector<size_t> playing_keys(const Deformation& deformation) {
  std::vector<size_t> playing;
  for (size_t i = 0; i < deformation.keyframes.size(); ++i)
    if (fits(deformation, deformation.keyframes[i].pose)) playing.push_back(i);
  return playing;
}

namespace {

template <class Test>
bool any_layer(const Scene& scene, Test test) {
  return std::ranges::any_of(scene.layers,
                             [&](const SharedLayer& layer) { return test(layer->deformation); });
}

}  // namespace

bool has_keyframes(const Scene& scene) {
  return any_layer(scene, [](const Deformation& layer) { return !layer.keyframes.empty(); });
}

bool has_playing_keys(const Scene& scene) {
  return any_layer(scene, [](const Deformation& layer) { return !playing_keys(layer).empty(); });
}

Error no_key_plays() {
  return {ErrorKind::bad_input,
          "none of the keyframes matches the scene's cage points, pins and strokes"};
}

bool has_time(const Scene& scene) {
  return has_keyframes(scene) || has_clips(scene);
}

bool moves(const Scene& scene) {
  return any_layer(scene, [](const Deformation& layer) { return playing_keys(layer).size() > 1; });
}

bool plays(const Scene& scene) {
  return moves(scene) || std::ranges::any_of(scene.layers, [](const SharedLayer& layer) {
           const Clip* clip = clip_of(*layer);
           return clip && played_frames(*clip) > 1 && end_of(*clip) > 0;
         });
}

double period_of(const Scene& scene) {
  const double length = length_of(scene);
  const bool ends_with_film = std::ranges::any_of(scene.layers, [&](const SharedLayer& layer) {
    const Clip* clip = clip_of(*layer);
    return clip && last_moment_of(*clip, scene.animation.frames_per_second) >= length;
  });
  return length + (ends_with_film ? 1 / scene.animation.frames_per_second : 0);
}

double length_of(const Scene& scene) {
  double length = 0;
  for (const SharedLayer& layer : scene.layers)
    if (const auto& keys = layer->deformation.keyframes; !keys.empty())
      length = std::max(length, keys.back().time);
  for (const SharedLayer& layer : scene.layers)
    if (const Clip* clip = clip_of(*layer))
      length = std::max(length, last_moment_of(*clip, scene.animation.frames_per_second));
  return std::min(length, kMaxTime);
}

int last_frame_of(const Scene& scene) {
  return static_cast<int>(std::ceil(length_of(scene) * scene.animation.frames_per_second - 1e-6));
}

std::vector<double> frame_times(const Scene& scene) {
  std::vector<double> times;
  for (int i = 0; i <= last_frame_of(scene); ++i)
    times.push_back(i / scene.animation.frames_per_second);
  return times;
}

}  // namespace holomorph
