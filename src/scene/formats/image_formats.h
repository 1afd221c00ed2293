// Picture formats: each is its library behind a function.
#pragma once

#include <optional>

#include "scene/formats/image.h"

namespace holomorph {

// Still pictures, upright and in sRGB. `name` is for messages. All throw Error{bad_input} for what
// is damaged, cut off, or more than the budget has left.
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
/// OpenRaster: the picture of all layers together, as the file has it.
bool is_ora(const std::string& bytes);
Image decode_ora(const std::string& bytes, const std::string& name, PixelBudget& pixels);
/// BMP, TGA and PSD; none for other files.
std::optional<Image> decode_plain(const std::string& bytes, const std::string& name,
                                  PixelBudget& pixels);

/// Without loss of what is seen: colours under no alpha may be others. Throws Error{failed}.
std::string encode_webp(const Image& image);

/// What Exif data says of the way in which the camera was held, 1 to 8 as Exif counts them: of a
/// JPEG file, or of a block that starts with "Exif".
int orientation_of_exif(const std::string& data);
/// Turned and mirrored so that its top is up.
Image upright(Image image, int orientation);

}  // namespace holomorph
