// A texture's colours carried over its edge, so that filters and slivers beyond it find them.
#pragma once

#include "scene/image.h"

namespace holomorph {

/// Pixels that are not covered and lie within `reach` of a covered one take the nearest such
/// pixel's colour and opacity; all others stay. Nearest up to the errors of 8-neighbour
/// propagation, well below a pixel. `covered` has an entry for each pixel, in rows from the top.
/// Cost: linear.
void bleed(Image& image, const std::vector<bool>& covered, double reach);

}  // namespace holomorph
