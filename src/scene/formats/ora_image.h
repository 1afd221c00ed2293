// OpenRaster files, which Krita, GIMP and MyPaint write: pictures with layers.
#pragma once

#include "scene/formats/image.h"

namespace holomorph {

/// A layer of an OpenRaster file, without its pixels.
struct OraLayer {
  std::string name, entry;  ///< what the user calls it, and its file in the archive
  bool visible = true;
  bool blended = false;  ///< by another mode than the usual one
};

/// The layers from the bottom to the top; groups are taken apart. Throws Error{bad_input}.
std::vector<OraLayer> ora_layers(const std::string& bytes, const std::string& name);
/// One layer on the whole canvas, its opacity in its pixels; blending modes are not kept. Throws
/// Error{bad_input}.
Image decode_ora_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels);

}  // namespace holomorph
