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

/// How many pixels may still be decoded, by all the pictures of a scene.
class PixelBudget {
 public:
  /// What is left when so many pixels are open already.
  explicit PixelBudget(double taken = 0) : taken_(taken) {}
  /// Before anything is decoded. Throws Error{bad_input} for more than are left, and for more than
  /// 16384 pixels a side. While it is decoded a picture may take the memory of several copies.
  void take(size_t width, size_t height, const std::string& name, double copies = 1);

 private:
  double taken_;
};

/// Decodes PNG, JPEG, WebP, TIFF, OpenRaster, GIF, BMP, TGA and PSD; upright, and in sRGB. `name`
/// is for messages. Throws Error{bad_input} for what is no picture, damaged, cut off or too large.
Image decode_image(const std::string& bytes, const std::string& name, PixelBudget& pixels);
inline Image decode_image(const std::string& bytes, const std::string& name) {
  PixelBudget alone;
  return decode_image(bytes, name, alone);
}

/// How files that decode_image may read are named: lower case, with the dot.
const std::vector<std::string>& picture_extensions();

/// The bytes of a PNG file.
std::string encode_png(const Image& image);

/// A kind of file that pictures are written to.
struct PictureFormat {
  std::string label, extension;
  std::string (*encode)(const Image& image);
};
/// PNG; JPEG, which has no transparency and is white there; WebP without loss of what is seen.
const std::vector<PictureFormat>& picture_formats();
/// A file's extension as formats name it: lower case, .jpg for .jpeg.
std::string format_extension(const Path& file);
/// By a file's extension, which is PNG's where there is none. Throws Error{bad_input} for others.
const PictureFormat& picture_format_of(const Path& file);

/// Whether any pixel's alpha is below 255.
bool has_transparency(const Image& image);

}  // namespace holomorph
