// The functions that read and write each picture format.
#pragma once

#include <optional>

#include "scene/formats/image.h"
#include "scene/formats/import_report.h"

namespace holomorph {

// Decoders of still pictures. The results are upright and in sRGB. `name` is used in messages. All
// throw Error{bad_input} if the data is damaged or truncated, or exceeds the budget.
bool is_png(const std::string& bytes);
Image decode_png(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 PixelDepth depth);
bool is_jpeg(const std::string& bytes);
Image decode_jpeg(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_webp(const std::string& bytes);
Image decode_webp(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_tiff(const std::string& bytes);
Image decode_tiff(const std::string& bytes, const std::string& name, PixelBudget& pixels);
bool is_exr(const std::string& bytes);
Image decode_exr(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 PixelDepth depth);
bool is_gif(const std::string& bytes);
Image decode_gif(const std::string& bytes, const std::string& name, PixelBudget& pixels);
/// OpenRaster: the merged picture of all layers that the file contains.
bool is_ora(const std::string& bytes);
Image decode_ora(const std::string& bytes, const std::string& name, PixelBudget& pixels);
/// The size of the picture of a drawing.
enum class DrawingSize { fit_for_work, own };
/// SVG: drawn as large as svg_document_of() says. Needs the program rsvg-convert.
bool is_svg(const std::string& bytes);
Image decode_svg(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 DrawingSize size = DrawingSize::fit_for_work);
/// BMP and TGA. None if the file has a different format.
std::optional<Image> decode_plain(const std::string& bytes, const std::string& name,
                                  PixelBudget& pixels);

// What the decoders above leave out of a file that they can decode, for the import report: pictures
// after the first one, and bits.
void report_png(const std::string& bytes, const std::string& name, ImportReport& report);
void report_webp(const std::string& bytes, const std::string& name, ImportReport& report);
void report_tiff(const std::string& bytes, const std::string& name, ImportReport& report);
void report_exr(const std::string& bytes, const std::string& name, ImportReport& report);
void report_gif(const std::string& bytes, const std::string& name, ImportReport& report);
/// Adds "only the first of its 12 pictures is opened"; nothing if there is one.
void report_first_of(size_t pictures, const char* what, ImportReport& report);

/// A PNG file with 16 bits, in sRGB. Throws Error{failed}.
std::string encode_png_16(const Image& image);
/// An OpenEXR file with linear, premultiplied colors of `depth` bits, 16 or 32. The primaries are
/// those of sRGB. Throws Error{failed}.
std::string encode_exr(const Image& image, int depth);
/// Lossless for all visible pixels; the colors of fully transparent pixels may change. Throws
/// Error{failed}.
std::string encode_webp(const Image& image);

/// The Exif orientation, 1 to 8, of a JPEG file or of a block that starts with "Exif"; 1 if none is
/// specified.
int orientation_of_exif(const std::string& data);
/// Rotates and mirrors a picture with this Exif orientation to make it upright.
Image upright(Image image, int orientation);

}  // namespace holomorph
