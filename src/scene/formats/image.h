// Pictures in memory and on disk.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types.h"
#include "system/file.h"

namespace holomorph {

/// A picture of 8-bit straight-alpha RGBA pixels, rows from top to bottom. The pixel in column c of
/// row r covers the plane's square [c, c + 1] x [height - r - 1, height - r].
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 per pixel

  Image() = default;
  Image(int width, int height)
      : width(width), height(height), pixels(static_cast<size_t>(width) * height * 4) {}
  bool operator==(const Image&) const = default;

  const std::uint8_t* at(int column, int row) const {
    return &pixels[4 * (static_cast<size_t>(row) * width + column)];
  }
  std::uint8_t* at(int column, int row) {
    return &pixels[4 * (static_cast<size_t>(row) * width + column)];
  }
};

/// The number of pixels that may still be decoded for the pictures of a scene.
class PixelBudget {
 public:
  /// A budget with `taken` pixels already in use.
  explicit PixelBudget(double taken = 0) : taken_(taken) {}
  /// Deducts a picture's pixels from the budget. Call it before decoding. Throws Error{bad_input}
  /// if the picture exceeds the remaining budget or 16384 pixels per side. `copies` is the number
  /// of copies of the picture that decoding holds in memory.
  void take(size_t width, size_t height, const std::string& name, double copies = 1);

 private:
  double taken_;
};

/// Decodes PNG, JPEG, WebP, TIFF, OpenRaster, OpenEXR, SVG, GIF, BMP, TGA and PSD. The result is
/// upright and in sRGB. `name` is used in messages. Throws Error{bad_input} if the bytes are not a
/// picture, or if the picture is damaged, truncated or too large.
Image decode_image(const std::string& bytes, const std::string& name, PixelBudget& pixels);
inline Image decode_image(const std::string& bytes, const std::string& name) {
  PixelBudget alone;
  return decode_image(bytes, name, alone);
}

/// Whether no pixel is transparent, not even partly.
bool is_opaque(const Image& image);

/// The bytes of a PNG file.
std::string encode_png(const Image& image);

/// A file format for writing pictures.
struct PictureFormat {
  std::string label, extension;
  std::string (*encode)(const Image& image);
};
/// PNG, JPEG and WebP. JPEG has no transparency; transparent areas become white. WebP is lossless
/// for all visible pixels.
const std::vector<PictureFormat>& picture_formats();
/// A file's extension in normal form: lower case, and .jpg instead of .jpeg.
std::string format_extension(const Path& file);
/// The format for a file's extension, or PNG for a file without one. Throws Error{bad_input} for
/// other extensions.
const PictureFormat& picture_format_of(const Path& file);

}  // namespace holomorph
