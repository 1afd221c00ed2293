// Keyframes are sorted by time and no two are at one time.
#include "scene/keyframes.h"

#include <algorithm>

#include "core/error.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

constexpr double kSameTime = 1e-3;

}  // namespace

size_t key_at(const Scene& scene, double time) {
  const auto found = std::ranges::find_if(
      scene.keyframes, [&](const Keyframe& key) { return std::abs(key.time - time) < kSameTime; });
  return static_cast<size_t>(found - scene.keyframes.begin());
}

Scene with_key(Scene scene, double time) {
  const size_t there = key_at(scene, time);
  Pose pose = whole_pose_of(scene);
  if (there < scene.keyframes.size()) {
    Keyframe& key = scene.keyframes[there];
    if (!fits(scene, key.pose)) key.pose_extra.clear();
    key.pose = std::move(pose);
    return scene;
  }
  const auto next = std::ranges::upper_bound(scene.keyframes, time, {}, &Keyframe::time);
  const Ease ease = next == scene.keyframes.begin() ? Ease::smooth : std::prev(next)->ease;
  scene.keyframes.insert(next, {time, std::move(pose), ease});
  return scene;
}

Scene without_key(Scene scene, size_t key) {
  scene.keyframes.erase(scene.keyframes.begin() + static_cast<long>(key));
  return scene;
}

std::pair<Scene, size_t> with_key_moved(Scene scene, size_t key, double time) {
  Keyframe moved = scene.keyframes[key];
  moved.time = std::clamp(time, 0.0, kLongestTime);
  scene = without_key(std::move(scene), key);
  if (const size_t there = key_at(scene, moved.time); there < scene.keyframes.size())
    scene = without_key(std::move(scene), there);
  const auto next = std::ranges::upper_bound(scene.keyframes, moved.time, {}, &Keyframe::time);
  const size_t number = static_cast<size_t>(next - scene.keyframes.begin());
  scene.keyframes.insert(next, std::move(moved));
  return {std::move(scene), number};
}

Scene with_ease(Scene scene, size_t key, Ease ease) {
  scene.keyframes[key].ease = ease;
  return scene;
}

std::vector<size_t> playing_keys(const Scene& scene) {
  std::vector<size_t> playing;
  for (size_t i = 0; i < scene.keyframes.size(); ++i)
    if (fits(scene, scene.keyframes[i].pose)) playing.push_back(i);
  return playing;
}

namespace {

template <class Test>
bool any_layer(const Scene& scene, Test test) {
  for (size_t i = 0; i < layer_count(scene); ++i)
    if (test(layer_at(scene, i))) return true;
  return false;
}

}  // namespace

bool has_keyframes(const Scene& scene) {
  return any_layer(scene, [](const Scene& layer) { return !layer.keyframes.empty(); });
}

bool has_playing_keys(const Scene& scene) {
  return any_layer(scene, [](const Scene& layer) { return !playing_keys(layer).empty(); });
}

Error no_key_plays() {
  return {ErrorKind::bad_input,
          "none of the keyframes has the scene's cage points, pins and strokes"};
}

bool plays(const Scene& scene) {
  return any_layer(scene, [](const Scene& layer) { return playing_keys(layer).size() > 1; });
}

double length_of(const Scene& scene) {
  double length = 0;
  for (size_t i = 0; i < layer_count(scene); ++i)
    if (const auto& keys = layer_at(scene, i).keyframes; !keys.empty())
      length = std::max(length, keys.back().time);
  return length;
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
