// OpenRaster files, which Krita, GIMP and MyPaint write: pictures with layers.
#pragma once

#include "scene/formats/image.h"

namespace holomorph {

/// A layer of an OpenRaster file, without its pixels.
struct OraLayer {
  std::string name, entry;  ///< the user's name for it, and its file in the archive
  bool visible = true;
  bool blended = false;  ///< with a blending mode other than the normal one
};

/// The layers from bottom to top, without their groups. Throws Error{bad_input}.
std::vector<OraLayer> ora_layers(const std::string& bytes, const std::string& name);
/// One layer on the whole canvas, with its opacity applied to the pixels. Blending modes are
/// ignored. Throws Error{bad_input}.
Image decode_ora_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels);

}  // namespace holomorph
