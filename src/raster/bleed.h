// Extends a texture's colors past the edge of its content, because texture filters and sliver
// triangles read colors there.
#pragma once

#include <functional>

#include "scene/formats/image.h"

namespace holomorph {

/// Gives each uncovered pixel within `reach` pixels of a covered one the color of the nearest
/// covered pixel. It also gets that pixel's opacity if `is_shown(column, row)` is true; otherwise
/// it becomes transparent. All other pixels keep their values. `covered` has one entry per pixel,
/// in rows from the top. Cost: linear in the number of pixels.
void bleed(Image& image, const std::vector<bool>& covered, double reach,
           const std::function<bool(int, int)>& is_shown);

}  // namespace holomorph
