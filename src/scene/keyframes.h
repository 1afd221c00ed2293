// Edits of a deformation's keyframes, the timeline that the layers of a scene share, and the effect
// of structural edits on keyframes.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// The index of the keyframe at a time, to a thousandth of a second; keyframes.size() if there is
/// none.
size_t key_at(const Deformation& deformation, double time);
/// Sets the keyframe at a time to the deformation's pose. An existing keyframe keeps its ease; an
/// added one has the ease of the keyframe before it.
Deformation with_key(Deformation deformation, double time);
Deformation without_key(Deformation deformation, size_t key);
/// Moves a keyframe to another time, clamped to the allowed range; a keyframe that is already there
/// is replaced. Returns the deformation and the key's index in it.
std::pair<Deformation, size_t> with_key_moved(Deformation deformation, size_t key, double time);
Deformation with_ease(Deformation deformation, size_t key, Ease ease);
/// The indices of the keyframes that play: those with the structure of the deformation.
std::vector<size_t> playing_keys(const Deformation& deformation);
/// Whether any layer has keyframes.
bool has_keyframes(const Scene& scene);
/// Whether any layer has a keyframe that plays.
bool has_playing_keys(const Scene& scene);
/// Whether any layer has at least two keyframes that play: whether the scene moves.
bool plays(const Scene& scene);
/// The error to throw if there are keyframes but none of them plays.
Error no_key_plays();
/// The latest key time in any layer; 0 without keyframes.
double length_of(const Scene& scene);
/// The index of the last frame. Frame i is at time i / frames_per_second; the last frame is at the
/// last key or just after it.
int last_frame_of(const Scene& scene);
/// The times of all frames, in seconds.
std::vector<double> frame_times(const Scene& scene);

/// The mirror image of a pose about the vertical line through the middle of the rest cage. Each
/// handle takes the mirrored pose of its counterpart on the other side at rest. Throws Error unless
/// the rest state has this symmetry to within 2 % of its size.
Pose mirrored(const Deformation& deformation, const Pose& pose);

/// Calls `edit` on the pose of each keyframe that has the deformation's structure. Call it with the
/// same edit before a structural edit of the deformation, so that the keyframes still fit.
template <class Edit>
void for_fitting_keys(Deformation& deformation, Edit edit) {
  for (Keyframe& key : deformation.keyframes)
    if (fits(deformation, key.pose)) edit(key.pose);
}

}  // namespace holomorph
