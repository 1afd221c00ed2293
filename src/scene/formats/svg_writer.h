// SVG files with layers.
#pragma once

#include "scene/formats/layered.h"

namespace holomorph {

/// The text of an SVG file in which layers are groups, named for Inkscape. Images are embedded as
/// PNG.
std::string encode_svg(const LayeredPicture& picture);

}  // namespace holomorph
