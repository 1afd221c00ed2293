// Smaller levels average premultiplied colors, which keeps the colors of transparent pixels from
// bleeding into their neighbors.
#include "render/texture_levels.h"

#include <algorithm>
#include <cstddef>

namespace holomorph {
namespace {

/// Averages blocks of factor x factor pixels, weighted by alpha, and premultiplies.
TextureLevel premultiplied(int width, int height, const std::uint8_t* pixels, int factor,
                           const std::function<bool()>& keep_going) {
  const int w = (width + factor - 1) / factor, h = (height + factor - 1) / factor;
  TextureLevel level{w, h, std::vector<std::uint8_t>(static_cast<size_t>(w) * h * 4)};
  if (factor == 1) {
    constexpr size_t kBetween = 1 << 22;
    for (size_t i = 0; i < level.pixels.size(); i += 4) {
      if (i % kBetween == 0 && !keep_going()) break;
      const unsigned alpha = pixels[i + 3];
      for (size_t k = 0; k < 3; ++k)
        level.pixels[i + k] = static_cast<std::uint8_t>((pixels[i + k] * alpha + 127) / 255);
      level.pixels[i + 3] = static_cast<std::uint8_t>(alpha);
    }
    return level;
  }
  for (int r = 0; r < h && keep_going(); ++r)
    for (int c = 0; c < w; ++c) {
      unsigned sum[4] = {0, 0, 0, 0}, count = 0;
      for (int y = r * factor; y < std::min(height, (r + 1) * factor); ++y)
        for (int x = c * factor; x < std::min(width, (c + 1) * factor); ++x, ++count) {
          const std::uint8_t* p = pixels + 4 * (static_cast<size_t>(y) * width + x);
          for (int k = 0; k < 3; ++k) sum[k] += (p[k] * p[3] + 127) / 255;
          sum[3] += p[3];
        }
      for (int k = 0; k < 4; ++k)
        level.pixels[4 * (static_cast<size_t>(r) * w + c) + k] =
            static_cast<std::uint8_t>((sum[k] + count / 2) / count);
    }
  return level;
}

/// The next smaller level: the mean of 2 x 2 pixels.
TextureLevel halved(const TextureLevel& from) {
  TextureLevel to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.pixels.resize(static_cast<size_t>(to.width) * to.height * 4);
  const size_t right = from.width > 1 ? 4 : 0,
               down = from.height > 1 ? 4 * static_cast<size_t>(from.width) : 0;
  std::uint8_t* out = to.pixels.data();
  for (int r = 0; r < to.height; ++r) {
    const std::uint8_t* in = from.pixels.data() + static_cast<size_t>(r) * 2 * down;
    for (int c = 0; c < to.width; ++c, in += 2 * right, out += 4)
      for (size_t k = 0; k < 4; ++k)
        out[k] = static_cast<std::uint8_t>(
            (in[k] + in[k + right] + in[k + down] + in[k + right + down] + 2) / 4);
  }
  return to;
}

}  // namespace

TextureLevels texture_levels(int width, int height, const std::uint8_t* pixels, int largest,
                             const std::function<bool()>& keep_going) {
  TextureLevels all{width, height, 1, {}};
  while ((std::max(width, height) + all.factor - 1) / all.factor > largest) ++all.factor;
  all.levels.push_back(premultiplied(width, height, pixels, all.factor, keep_going));
  while ((all.levels.back().width > 1 || all.levels.back().height > 1) && keep_going())
    all.levels.push_back(halved(all.levels.back()));
  return all;
}

}  // namespace holomorph
