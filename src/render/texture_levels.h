// A picture as textures want it: premultiplied, with all of its smaller versions.
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
  int factor = 1;             ///< by which it had to be reduced
  std::vector<TextureLevel>
      levels;  ///< the largest first, each half of the one before, down to 1 x 1
};

/// Of a picture of straight-alpha RGBA, rows from the top, which may not be empty; no level is
/// larger than `largest` a side. Needs no OpenGL and may run on any thread. Cost: linear, about
/// 10 ns a pixel. `go_on` is asked now and then; what is returned after it said no is incomplete.
TextureLevels texture_levels(
    int width, int height, const std::uint8_t* pixels, int largest,
    const std::function<bool()>& go_on = [] { return true; });

}  // namespace holomorph
