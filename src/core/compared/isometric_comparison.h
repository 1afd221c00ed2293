// Compares methods with pins: the puppet, the method of Chen and Weber, and others.
#pragma once

#include "core/compared/comparison.h"

namespace holomorph {

/// Compares maps for a rest and pose of method `puppet`. The rows are this program's map, that of
/// Chen, Weber 2017 with the same basis and pin weight (not for cages with holes), and those of the
/// other methods with pins. All maps are measured in the triangles of the mesh. `on_row` receives
/// each row as soon as it is finished; `stop` ends the work early. Throws Error under the same
/// conditions as the methods, and without pins.
void compare_isometric(const Rest& rest, const Pose& pose,
                       const std::function<void(const ComparedMap&)>& on_row,
                       std::stop_token stop = {});

}  // namespace holomorph
