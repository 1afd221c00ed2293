// Pictures in memory and on disk.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types.h"
#include "scene/formats/import_report.h"
#include "system/file.h"

namespace holomorph {

/// A picture of 8-bit straight-alpha RGBA pixels, rows from top to bottom. The pixel in column c of
/// row r covers the plane's square [left + c, left + c + 1] x [top() - r - 1, top() - r].
struct Image {
  int width = 0, height = 0;
  int left = 0, bottom = 0;  ///< its lower left corner in the plane
  /// The canvas of the file, in the plane, if the picture is a layer that lies somewhere on it.
  std::optional<Box> canvas = {};
  std::vector<std::uint8_t> pixels;  ///< 4 per pixel
  /// The same pixels before they were rounded, or empty, which is usual. 255 is white or opaque, as
  /// in `pixels`, but colors may be brighter than white.
  std::vector<float> fine;

  Image() = default;
  Image(int width, int height)
      : width(width), height(height), pixels(static_cast<size_t>(width) * height * 4) {}
  bool operator==(const Image&) const = default;

  int top() const { return bottom + height; }
  /// The rectangle that the pixels cover.
  Box box() const {
    return {double(left), double(bottom), double(left) + width, double(bottom) + height};
  }
  /// The rectangle that the picture is a picture of: the canvas, or else that of its pixels.
  Box page() const { return canvas.value_or(box()); }

  /// Where a pixel starts in `pixels` and in `fine`.
  size_t index(int column, int row) const {
    return 4 * (static_cast<size_t>(row) * static_cast<size_t>(width) + column);
  }
  const std::uint8_t* at(int column, int row) const { return &pixels[index(column, row)]; }
  std::uint8_t* at(int column, int row) { return &pixels[index(column, row)]; }
};

/// Sets the 8-bit pixels to the rounded fine pixels, if the picture has some.
void round_fine(Image& image);
/// Whether a pixel is not fully transparent.
inline bool is_filled(const Image& image, int column, int row) {
  const size_t alpha = image.index(column, row) + 3;
  return image.fine.empty() ? image.pixels[alpha] > 0 : image.fine[alpha] > 0;
}
/// Rows and columns of a picture, from the first to behind the last.
struct PixelRange {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool empty() const { return right <= left; }
};
/// The pixels that are not fully transparent.
PixelRange filled_range(const Image& image);
/// A transparent pixel at the lower left corner of a canvas.
Image nothing_on(const Box& canvas);
/// A part of a picture, in whole pixels.
Image cut_out(const Image& image, int left, int top, int width, int height);

/// What is read of pictures with more than 8 bits.
enum class PixelDepth { eight_bits, full };
/// The memory of a picture with fine pixels, in pictures of 8 bits.
inline constexpr double kFineCopies = 5;

/// The number of pixels that may still be decoded for the pictures of a scene.
class PixelBudget {
 public:
  /// A budget with `taken` pixels already in use.
  explicit PixelBudget(double taken = 0) : taken_(taken) {}
  static constexpr size_t kLargestSide = 16384;  ///< of a picture, in pixels
  /// Deducts a picture's pixels from the budget. Call it before decoding. Throws Error{bad_input}
  /// if the picture exceeds the remaining budget or kLargestSide. `copies` is the number
  /// of copies of the picture that decoding holds in memory.
  void take(size_t width, size_t height, const std::string& name, double copies = 1);

 private:
  double taken_;
};

/// Decodes PNG, JPEG, WebP, TIFF, OpenRaster, OpenEXR, SVG, GIF, BMP, TGA and PSD. The result is
/// upright and in sRGB. `name` is used in messages. Throws Error{bad_input} if the bytes are not a
/// picture, or if the picture is damaged, truncated or too large. With PixelDepth::full, the result
/// has fine pixels if the file is a PNG file with 16 bits or an OpenEXR file.
Image decode_image(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                   PixelDepth depth = PixelDepth::eight_bits);
inline Image decode_image(const std::string& bytes, const std::string& name) {
  PixelBudget alone;
  return decode_image(bytes, name, alone);
}
/// What decode_image() leaves out of a file that it can decode.
ImportReport report_of_image(const std::string& bytes, const std::string& name);
/// Whether a file that starts with these bytes may have more than 8 bits that can be read.
bool has_fine_pixels(const std::string& start);

/// Whether no pixel of the page is transparent, not even partly.
bool is_opaque(const Image& image);

/// The bytes of a PNG file.
std::string encode_png(const Image& image);

/// A file format for writing pictures.
struct PictureFormat {
  std::string label, extension;
  std::vector<int> depths;  ///< the bits that colors may have; the usual number first
  std::string (*encode)(const Image& image, int depth);
};
/// PNG, JPEG, WebP and OpenEXR. JPEG has no transparency; transparent areas become white. WebP is
/// lossless for all visible pixels. OpenEXR is linear and premultiplied.
const std::vector<PictureFormat>& picture_formats();
/// The format of an extension in normal form; null if there is none.
const PictureFormat* picture_format_named(const std::string& extension);
/// Such as "8 or 16".
std::string depths_text(const PictureFormat& format);
/// The wanted depth if the format has it; otherwise the usual one.
int depth_of(const PictureFormat& format, const std::optional<int>& wanted);
/// Whether colors with this number of bits need fine pixels.
inline bool needs_fine_pixels(int depth) {
  return depth > 8;
}
/// A file's extension in normal form: lower case, and .jpg instead of .jpeg.
std::string format_extension(const Path& file);
/// The format for a file's extension, or PNG for a file without one. Throws Error{bad_input} for
/// other extensions.
const PictureFormat& picture_format_of(const Path& file);

}  // namespace holomorph
