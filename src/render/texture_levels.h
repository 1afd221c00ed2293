// A picture prepared for use as a texture: premultiplied, with all mipmap levels.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace holomorph {

struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< premultiplied RGBA
};

struct TextureLevels {
  int width = 0, height = 0;  ///< the picture's own size
  int factor = 1;             ///< the factor by which the picture was reduced
  std::vector<TextureLevel>
      levels;  ///< largest first, each half the size of the previous one, down to 1 x 1
};

/// The levels of a picture, which must not be empty: straight-alpha RGBA, rows from the top. No
/// level has more than `largest` pixels on a side. Needs no OpenGL and may run on any thread. Calls
/// `keep_going` from time to time; the result is incomplete if that returns false. Cost: linear,
/// about 10 ns per pixel.
TextureLevels texture_levels(
    int width, int height, const std::uint8_t* pixels, int largest,
    const std::function<bool()>& keep_going = [] { return true; });

}  // namespace holomorph
