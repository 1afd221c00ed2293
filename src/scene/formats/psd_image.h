// Photoshop files with layers. No library of the distribution reads and writes layers with groups,
// masks and clipping.
#pragma once

#include "scene/formats/layered.h"

namespace holomorph {

bool is_psd(const std::string& bytes);
/// Reads the layers. Throws Error{bad_input}.
FileLayers psd_layers(const std::string& bytes, const std::string& name);
/// Decodes one layer and applies its mask. Throws Error{bad_input}.
Image decode_psd_layer(const std::string& bytes, const std::string& entry, const std::string& name,
                       PixelBudget& pixels);
/// Decodes the merged picture. Throws Error{bad_input}.
Image decode_psd(const std::string& bytes, const std::string& name, PixelBudget& pixels);

/// The bytes of a PSD file (RGBA, 8 bits, run lengths). Throws Error{failed} if it would exceed the
/// format's limit of 2 GB.
std::string encode_psd(const LayeredPicture& picture);

}  // namespace holomorph
