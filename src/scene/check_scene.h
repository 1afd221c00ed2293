// Checks that a scene can be saved and opened again.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// Throws Error{bad_input} if scene_from_json would reject the file that json_of writes. The
/// message names the layer and the part. Examples are coordinates that are not finite or too large,
/// too many parts, an unusable rest cage, parameters out of range, keyframes out of order, file
/// names that are not UTF-8, and a file that exceeds the budget. Cost: one check_rest_cage per
/// cage, and a few ns per number. The text is generated only if it might be too large.
void check_scene(const Scene& scene);

/// Throws Error{bad_input} if a handle or the outline has coordinates that are not finite or larger
/// than kMaxCoordinate, as check_scene would. Cost: a few ns per number.
void check_coordinates(const Deformation& deformation);

}  // namespace holomorph
