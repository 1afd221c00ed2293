// Edits to a deformation's keyframes, the timeline that a scene's layers share, and the effect of
// structural edits on keyframes.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// Keyframes that are closer than this, in seconds, have the same time.
inline constexpr double kSameTime = 1e-3;
/// The index of the keyframe with the given time; keyframes.size() if
/// there is none.
size_t key_at(const Deformation& deformation, double time);
/// Sets the keyframe at a time to the deformation's pose. An existing keyframe keeps its ease. A
/// new keyframe gets the ease of the keyframe before it.
Deformation with_key(Deformation deformation, double time);
Deformation without_key(Deformation deformation, size_t key);
/// The indices of the keyframes that play, that is, whose poses fit the deformation.
std::vector<size_t> playing_keys(const Deformation& deformation);
/// Whether any layer has keyframes.
bool has_keyframes(const Scene& scene);
/// Whether any layer has a keyframe that plays.
bool has_playing_keys(const Scene& scene);
/// Whether the scene may differ from one time to another: any layer has keyframes or a film.
bool has_time(const Scene& scene);
/// Whether the map of any layer moves, that is, whether a layer has at least two keyframes that
/// play.
bool moves(const Scene& scene);
/// Whether the scene moves: moves(), or a layer has a film.
bool plays(const Scene& scene);
/// The error to throw if there are keyframes but none of them plays.
Error no_key_plays();
/// The latest key time in any layer, or the time until which the scene shows the last frame of a
/// film if that is later, see last_moment_of(); 0 without either.
double length_of(const Scene& scene);
/// The time after which playback repeats: length_of(), and a frame more if a film ends there, whose
/// last frame is then shown as long as the others.
double period_of(const Scene& scene);
/// The index of the last frame. Frame i is at time i / frames_per_second. The last frame is at the
/// time length_of(scene), or just after it.
int last_frame_of(const Scene& scene);
/// The times of all frames, in seconds.
std::vector<double> frame_times(const Scene& scene);

/// Calls `edit` on each keyframe pose that fits the deformation. Before a structural edit of the
/// deformation, call this function with the same edit to keep the keyframes fitting.
template <class Edit>
void for_fitting_keys(Deformation& deformation, Edit edit) {
  for (Keyframe& key : deformation.keyframes)
    if (fits(deformation, key.pose)) edit(key.pose);
}

}  // namespace holomorph
