// What poses are made of, as JSON: curves, cages, corners, keyframes.
#pragma once

#include "scene/formats/json_reader.h"

namespace holomorph {

Cage read_loop(const Reader& list);
/// Points that a check, which throws Error, accepts.
Points read_curve(const Reader& reader, void (*check)(std::span<const Complex>));
/// A corner more of the deformation: they come by increasing vertex.
Corner read_corner(const Reader& reader, const Deformation& deformation);
/// A keyframe more of a deformation that has all else: they come by increasing time. What its pose
/// lacks is as it rests.
Keyframe read_keyframe(const Reader& reader, const Deformation& deformation);
AnimationSettings read_animation(const Reader& reader);

Json point_json(Complex z);
Json curve_json(const Points& curve);
Json loop_json(const Cage& cage);
Json corner_json(const Corner& corner);
Json keyframe_json(const Keyframe& key, const Deformation& deformation);
Json animation_json(const AnimationSettings& settings);
/// Writes back what this version does not know.
void add_extra(Json& object, const Extra& extra);

}  // namespace holomorph
