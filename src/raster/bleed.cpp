// Copies colors from the nearest covered pixels.
#include "raster/bleed.h"

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "raster/nearest_covered.h"

namespace holomorph {

void bleed(Image& image, const std::vector<bool>& covered, double reach,
           const std::function<bool(int, int)>& is_shown) {
  check(covered.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
        "bleed: `covered` does not have one entry per pixel");
  const NearestCovered nearest(image.width, image.height, covered);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const PixelIndex from = nearest.at(c, r);
      if (from.column < 0) continue;
      const double distance = std::hypot(c - from.column, r - from.row);
      if (!(distance > 0 && distance <= reach)) continue;
      std::memcpy(image.at(c, r), image.at(from.column, from.row), 3);
      image.at(c, r)[3] = is_shown(c, r) ? image.at(from.column, from.row)[3] : 0;
    }
}

}  // namespace holomorph
