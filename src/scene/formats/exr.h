// OpenEXR files: pictures of floating-point numbers.
#pragma once

#include <string>
#include <vector>

namespace holomorph {

/// A picture of linear, premultiplied RGBA in 32-bit floats, rows from the top. It extends beyond
/// the rectangle that is displayed by the same number of pixels on each side.
struct FloatImage {
  int width = 0, height = 0;  ///< including the overscan
  int overscan = 0;
  std::vector<float> pixels;  ///< 4 per pixel
};

enum class FloatBits { half = 16, single = 32 };

/// The bytes of an OpenEXR file, compressed without loss (ZIP). The upper left corner of its
/// display window is (0, 0). Half floats keep 11 bits; larger numbers than 65504 become 65504.
/// Throws Error{failed}.
std::string exr_of(const FloatImage& image, FloatBits bits);

}  // namespace holomorph
