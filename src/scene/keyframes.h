// Edits of a deformation's keyframes, and what a scene's layers play together, and what edits of
// its structure do to them.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The keyframe at a time, to a thousandth of a second; none: its number is keyframes.size().
size_t key_at(const Deformation& deformation, double time);
/// With the deformation's pose as the keyframe at a time; one that is there keeps its ease, a new
/// one goes on as the one before it.
Deformation with_key(Deformation deformation, double time);
Deformation without_key(Deformation deformation, size_t key);
/// A keyframe at another time, clamped to what is allowed; one that is there already is replaced.
/// Returns the deformation and the key's new number.
std::pair<Deformation, size_t> with_key_moved(Deformation deformation, size_t key, double time);
Deformation with_ease(Deformation deformation, size_t key, Ease ease);
/// The keyframes that play: those that have the deformation's structure.
std::vector<size_t> playing_keys(const Deformation& deformation);
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
Pose mirrored(const Deformation& deformation, const Pose& pose);

/// Calls `edit` for the poses of keyframes that have the deformation's structure: made beside the
/// same edit of the deformation, before it.
template <class Edit>
void for_fitting_keys(Deformation& deformation, Edit edit) {
  for (Keyframe& key : deformation.keyframes)
    if (fits(deformation, key.pose)) edit(key.pose);
}

}  // namespace holomorph
