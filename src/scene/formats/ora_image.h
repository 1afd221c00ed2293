// OpenRaster files: pictures with layers, written by Krita, GIMP and MyPaint.
#pragma once

#include "scene/formats/layered.h"

namespace holomorph {

/// The layers, except those that are not PNG files. Throws Error{bad_input}.
FileLayers ora_layers(const std::string& bytes, const std::string& name);
/// Decodes one layer, and applies its opacity to the pixels. Throws Error{bad_input}.
Image decode_ora_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels);

/// The bytes of an OpenRaster file. Clipped layers are cut to the shape of their base, because the
/// format has no clipping. Throws Error{failed}.
std::string encode_ora(const LayeredPicture& picture);

}  // namespace holomorph
