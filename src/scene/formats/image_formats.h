// The picture formats. Each wraps its library in functions.
#pragma once

#include <optional>

#include "scene/formats/image.h"

namespace holomorph {

// Decoders of still pictures, upright and in sRGB. `name` is used in messages. All throw
// Error{bad_input} if the data are damaged, truncated, or more than the budget has left.
bool is_png(const std::string& bytes);
Image decode_png(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_jpeg(const std::string& bytes);
Image decode_jpeg(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_webp(const std::string& bytes);
Image decode_webp(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_tiff(const std::string& bytes);
Image decode_tiff(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_gif(const std::string& bytes);
Image decode_gif(const std::string& bytes, const std::string& name, PixelBudget& pixels);
/// OpenRaster: the merged picture of all layers that the file contains.
bool is_ora(const std::string& bytes);
Image decode_ora(const std::string& bytes, const std::string& name, PixelBudget& pixels);
/// BMP, TGA and PSD; none for other files.
std::optional<Image> decode_plain(const std::string& bytes, const std::string& name,
                                  PixelBudget& pixels);

/// Lossless for all visible pixels; the colors of fully transparent pixels may change. Throws
/// Error{failed}.
std::string encode_webp(const Image& image);

/// The orientation in which the camera was held, 1 to 8 as in Exif, from a JPEG file or from a
/// block that starts with "Exif". 1 if there is none.
int orientation_of_exif(const std::string& data);
/// The picture of this Exif orientation, rotated and mirrored so that it is upright.
Image upright(Image image, int orientation);

}  // namespace holomorph
