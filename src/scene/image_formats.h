// Formats beside the everyday ones; each is its library behind a function.
#pragma once

#include "scene/image.h"

namespace holomorph {

bool is_webp(const std::string& bytes);
bool is_tiff(const std::string& bytes);
/// Still pictures. Throw Error{bad_input}.
Image decode_webp(const std::string& bytes, const std::string& name);
Image decode_tiff(const std::string& bytes, const std::string& name);

/// Without loss of what is seen: colours under no alpha may be others. Throws Error{failed}.
std::string encode_webp(const Image& image);

/// OpenRaster: the picture of all layers together, as the file has it. Throws Error{bad_input}.
bool is_ora(const std::string& bytes);
Image decode_ora(const std::string& bytes, const std::string& name);

/// Throws Error{bad_input} for more than 16384 pixels a side.
void check_image_size(int width, int height, const std::string& name);

}  // namespace holomorph
