// Whether a scene can be written and opened again.
#pragma once

#include "scene/scene.h"

namespace holomorph {

/// Throws Error{bad_input} naming the layer and the part for everything that scene_from_json would
/// refuse in the file that json_of writes: coordinates that are not finite or too large, too many
/// parts, a rest cage that cannot be used, parameters out of range, keyframes out of order, file
/// names that are not UTF-8, a file beyond the budget. Cost: that of check_rest_cage for each cage,
/// and a few ns for each number; the file itself is written only if it might be too large.
void check_scene(const Scene& scene);

}  // namespace holomorph
