// Edits of a scene's keyframes, and what edits of its structure do to them.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The keyframe at a time, to a thousandth of a second; none: its number is keyframes.size().
size_t key_at(const Scene& scene, double time);
/// With the scene's pose as the keyframe at a time; one that is there keeps its ease, a new one
/// goes on as the one before it.
Scene with_key(Scene scene, double time);
Scene without_key(Scene scene, size_t key);
/// A keyframe at another time, clamped to what is allowed; one that is there already is replaced.
/// Returns the scene and the key's new number.
std::pair<Scene, size_t> with_key_moved(Scene scene, size_t key, double time);
Scene with_ease(Scene scene, size_t key, Ease ease);
/// The keyframes that play: those that have the scene's structure.
std::vector<size_t> playing_keys(const Scene& scene);
/// Whether any layer has keyframes, has some that play, and moves.
bool has_keyframes(const Scene& scene);
bool has_playing_keys(const Scene& scene);
bool plays(const Scene& scene);
/// What to throw where there are keyframes and none of them plays.
Error no_key_plays();
/// The last key's time in any layer, 0 without any.
double length_of(const Scene& scene);
/// Frame i is at time i / frames_per_second; the last one is at the last key or just behind it.
int last_frame_of(const Scene& scene);
/// The times of all frames, in seconds.
std::vector<double> frame_times(const Scene& scene);

/// A pose mirrored left to right at rest: what stands on one side at rest goes where its
/// counterpart went, mirrored about the vertical line through the middle of the cage at rest.
/// Throws Error when the rest has no such symmetry, to 2 % of its size.
Pose mirrored(const Scene& scene, const Pose& pose);

/// Calls `edit` for the poses of keyframes that have the scene's structure: made beside the same
/// edit of the scene, before it.
template <class Edit>
void for_fitting_keys(Scene& scene, Edit edit) {
  for (Keyframe& key : scene.keyframes)
    if (fits(scene, key.pose)) edit(key.pose);
}

}  // namespace holomorph
