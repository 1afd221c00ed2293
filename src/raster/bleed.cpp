// Two sweeps propagate the nearest covered pixel from neighbor to neighbor (Danielsson 1980).
#include "raster/bleed.h"

#include <cstring>

#include "core/error.h"

namespace holomorph {
namespace {

struct Pixel {
  int c = -1, r = -1;  ///< column and row; negative: no covered pixel found yet
};

class Nearest {
 public:
  Nearest(int width, int height, const std::vector<bool>& covered)
      : width_(width), height_(height), found_(covered.size()) {
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c)
        if (covered[index(c, r)]) found_[index(c, r)] = {c, r};
    for (int r = 0; r < height; ++r) {
      for (int c = 0; c < width; ++c)
        for (const auto& [dc, dr] : {Pixel{-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
          propagate(c, r, dc, dr);
      for (int c = width - 1; c >= 0; --c) propagate(c, r, 1, 0);
    }
    for (int r = height - 1; r >= 0; --r) {
      for (int c = width - 1; c >= 0; --c)
        for (const auto& [dc, dr] : {Pixel{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) propagate(c, r, dc, dr);
      for (int c = 0; c < width; ++c) propagate(c, r, -1, 0);
    }
  }

  Pixel at(int c, int r) const { return found_[index(c, r)]; }
  static double distance(int c, int r, Pixel from) {
    return from.c < 0 ? INFINITY : std::hypot(c - from.c, r - from.r);
  }

 private:
  size_t index(int c, int r) const {
    return static_cast<size_t>(r) * static_cast<size_t>(width_) + static_cast<size_t>(c);
  }
  void propagate(int c, int r, int dc, int dr) {
    if (c + dc < 0 || c + dc >= width_ || r + dr < 0 || r + dr >= height_) return;
    const Pixel candidate = at(c + dc, r + dr);
    if (distance(c, r, candidate) < distance(c, r, at(c, r))) found_[index(c, r)] = candidate;
  }

  int width_, height_;
  std::vector<Pixel> found_;
};

}  // namespace

void bleed(Image& image, const std::vector<bool>& covered, double reach,
           const std::function<bool(int, int)>& is_shown) {
  check(covered.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
        "bleed: `covered` does not have one entry per pixel");
  const Nearest nearest(image.width, image.height, covered);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const Pixel from = nearest.at(c, r);
      const double distance = Nearest::distance(c, r, from);
      if (!(distance > 0 && distance <= reach)) continue;
      std::memcpy(image.at(c, r), image.at(from.c, from.r), 3);
      image.at(c, r)[3] = is_shown(c, r) ? image.at(from.c, from.r)[3] : 0;
    }
}

}  // namespace holomorph
