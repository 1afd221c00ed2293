// Sets of keyframes of several layers, and edits of all of them at once.
#pragma once

#include <compare>
#include <map>
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

/// Copies of keyframes, in the order of time.
struct CopiedKeys {
  std::map<int, std::vector<Keyframe>> layers;  ///< by the id of their layer

  bool empty() const { return layers.empty(); }
  KeySelection keys() const;
};
/// Copies of the editable keyframes of a selection. They keep the whole turns between them.
CopiedKeys copied_keys(const Scene& scene, const KeySelection& keys);
/// Those of the copies that fit the scene: their layers exist and can be edited, and still have the
/// cage, pins and strokes of the poses.
CopiedKeys fitting(const Scene& scene, CopiedKeys copied);

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
/// Adds copies of keyframes that fit the scene, moved in time. None as for with_keys_moved().
std::optional<MovedKeys> with_keys_pasted(const Scene& scene, const CopiedKeys& copied,
                                          const TimeMap& map, bool to_frames = false);
Scene with_keys_eased(Scene scene, const KeySelection& keys, Ease ease);
Scene without_keys(Scene scene, const KeySelection& keys);
/// Mirrors the poses of keyframes. Throws Error like mirrored().
Scene with_keys_mirrored(Scene scene, const KeySelection& keys);
/// The ease that all keyframes share; none if they differ, or if there are none.
std::optional<Ease> common_ease(const Scene& scene, const KeySelection& keys);

}  // namespace holomorph
