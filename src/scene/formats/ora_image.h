// OpenRaster files: pictures with layers, written by Krita, GIMP and MyPaint.
#pragma once

#include "scene/formats/image.h"

namespace holomorph {

/// A layer of an OpenRaster file, without its pixels.
struct OraLayer {
  std::string name, entry;  ///< the layer's name, and its file in the archive
  bool visible = true;
  bool blended = false;  ///< has a blending mode other than normal
};

/// The layers from bottom to top, as a flat list without groups. Throws Error{bad_input}.
std::vector<OraLayer> ora_layers(const std::string& bytes, const std::string& name);
/// Decodes one layer as a picture of the canvas's size. The layer's opacity is applied to the
/// pixels. Blending modes are ignored. Throws Error{bad_input}.
Image decode_ora_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels);

}  // namespace holomorph
