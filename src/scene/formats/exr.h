// OpenEXR files: pictures of floating-point numbers.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace holomorph {

/// The size of a picture that extends beyond the rectangle that is displayed by the same number of
/// pixels on each side.
struct FloatShape {
  int width = 0, height = 0;  ///< including the overscan
  int overscan = 0;
};
/// A picture with four channels of 32-bit floats, R, G, B and A, rows from the top.
struct FloatImage : FloatShape {
  std::vector<float> pixels;  ///< 4 per pixel
};

enum class FloatBits { half = 16, single = 32 };

/// The bytes of an OpenEXR file, compressed without loss (ZIP). The upper left corner of its
/// display window is (0, 0). Half floats keep 11 bits; numbers larger than 65504 become 65504.
/// Numbers are stored as given. `write_row` writes the numbers of a row, 4 per pixel; it is called
/// once for each row, from the top. Throws Error{failed}.
std::string exr_of(const FloatShape& shape, FloatBits bits,
                   const std::function<void(int row, float* out)>& write_row);
std::string exr_of(const FloatImage& image, FloatBits bits);

}  // namespace holomorph
