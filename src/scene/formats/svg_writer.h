// SVG files with layers.
#pragma once

#include "scene/formats/layered.h"

namespace holomorph {

/// The text of an SVG file in which layers are groups, named for Inkscape. Images are embedded as
/// PNG. Where a clipped layer's base is partly transparent, the edges differ slightly from
/// Blending's definition, because SVG has no operator for it in groups.
std::string encode_svg(const LayeredPicture& picture);

}  // namespace holomorph
