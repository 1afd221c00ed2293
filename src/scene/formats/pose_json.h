// Reads and writes the parts of poses as JSON: curves, cages, corners, keyframes.
#pragma once

#include "scene/formats/json_reader.h"

namespace holomorph {

/// One loop of a cage.
Cage read_loop(const Reader& list);
/// Reads points and passes them to `check`, which throws Error if they are invalid.
Points read_curve(const Reader& reader, void (*check)(std::span<const Complex>));
/// Reads the next corner of a deformation. The corners in a file are sorted by vertex.
Corner read_corner(const Reader& reader, const Deformation& deformation);
/// Reads the next keyframe of a deformation. All other parts of the deformation must have been
/// read. The keyframes in a file are sorted by time. Missing parts of the pose are at rest.
Keyframe read_keyframe(const Reader& reader, const Deformation& deformation);
AnimationSettings read_animation(const Reader& reader);

Json point_json(Complex z);
Json curve_json(const Points& curve);
Json loop_json(const Cage& cage, Index loop);
Json corner_json(const Corner& corner);
Json keyframe_json(const Keyframe& key, const Deformation& deformation);
Json animation_json(const AnimationSettings& settings);
/// Adds the keys that this version does not know to an object.
void add_extra(Json& object, const Extra& extra);

}  // namespace holomorph
