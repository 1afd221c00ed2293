// A texture's colours carried over its edge, so that filters and slivers beyond it find them.
#pragma once

#include <functional>

#include "scene/formats/image.h"

namespace holomorph {

/// Pixels that are not covered and lie within `reach` of a covered one take the nearest such
/// pixel's colour, and its opacity, too, where `is_shown` says so (column, row); elsewhere they
/// stay transparent. All others stay as they are. Nearest up to the errors of 8-neighbour
/// propagation, well below a pixel. `covered` has an entry for each pixel, in rows from the top.
/// Cost: linear.
void bleed(Image& image, const std::vector<bool>& covered, double reach,
           const std::function<bool(int, int)>& is_shown);

}  // namespace holomorph
