// Sets of keyframes of several layers, and edits of all of them at once.
#pragma once

#include <compare>
#include <set>

#include "scene/keyframes.h"

namespace holomorph {

/// A keyframe of a scene.
struct KeyId {
  int layer = 0;    ///< the id of its layer
  double time = 0;  ///< seconds
  auto operator<=>(const KeyId&) const = default;
};
using KeySelection = std::set<KeyId>;

/// t -> to + factor (t - from).
struct TimeMap {
  double factor = 1, from = 0, to = 0;
  double operator()(double time) const { return to + factor * (time - from); }
};

/// All keyframes of a scene.
KeySelection all_keys(const Scene& scene);
/// The keyframes of a selection that exist and whose layers are visible and not locked.
KeySelection editable_keys(const Scene& scene, const KeySelection& keys);
/// The first and last time of a selection, which must not be empty.
std::pair<double, double> span_of(const KeySelection& keys);

struct MovedKeys {
  Scene scene;
  KeySelection keys;  ///< where they are now
};
struct KeyMove {
  bool to_frames = false;  ///< round the new times to whole frames
  bool copies = false;     ///< the keyframes also stay where they were
};
/// Moves the editable keyframes of a selection in time. None if one would leave the allowed range
/// or meet another one.
std::optional<MovedKeys> with_keys_moved(const Scene& scene, const KeySelection& keys,
                                         const TimeMap& map, KeyMove how = {});
Scene with_keys_eased(Scene scene, const KeySelection& keys, Ease ease);
Scene without_keys(Scene scene, const KeySelection& keys);
/// Mirrors the poses of keyframes. Throws Error like mirrored().
Scene with_keys_mirrored(Scene scene, const KeySelection& keys);
/// The ease that all keyframes share; none if they differ, or if there are none.
std::optional<Ease> common_ease(const Scene& scene, const KeySelection& keys);

}  // namespace holomorph
