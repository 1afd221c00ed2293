// Uses only integer arithmetic, which keeps opaque pixels and pixels of a single picture exact.
#include "raster/compose.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"

namespace holomorph {
namespace {

/// x / 255, rounded, for 0 <= x <= 255^2.
unsigned divided_by_255(unsigned x) {
  return (x + 127) / 255;
}

/// The color channel that a blending mode makes of the colors above and below.
unsigned blended(Blending mode, unsigned over, unsigned under) {
  switch (mode) {
    case Blending::multiply:
      return divided_by_255(over * under);
    case Blending::screen:
      return over + under - divided_by_255(over * under);
    case Blending::overlay:
      return under < 128 ? divided_by_255(2 * over * under)
                         : 255 - divided_by_255(2 * (255 - over) * (255 - under));
    case Blending::add:
      return std::min(255u, over + under);
    case Blending::normal:
      break;
  }
  return over;
}

/// Blends the pixel `over` onto the pixel `under`, both in straight alpha (W3C Compositing and
/// Blending, 5.6 and 9.1.3).
void blend(const std::uint8_t* over, std::uint8_t* under, const LayerInk& ink = {}) {
  const unsigned a = divided_by_255(over[3] * ink.opacity), b = under[3];
  const bool is_normal = ink.blending == Blending::normal;
  if (a == 0 || (b == 0 && ink.clipped)) return;
  if ((a == 255 && is_normal) || b == 0) {
    std::memcpy(under, over, 3);
    if (!ink.clipped) under[3] = static_cast<std::uint8_t>(a);
    return;
  }
  // Weights of the colors above, below and blended, in units of 1 / 255^2. With clipping, the alpha
  // below is that of the result (source-atop).
  const unsigned both = a * b, above = a * (255 - b), below = (ink.clipped ? 255 : b) * (255 - a),
                 all = above + below + both;
  for (int k = 0; k < 3; ++k) {
    const unsigned mixed = blended(ink.blending, over[k], under[k]);
    under[k] = static_cast<std::uint8_t>(
        (above * over[k] + below * under[k] + both * mixed + all / 2) / all);
  }
  if (!ink.clipped) under[3] = static_cast<std::uint8_t>((all + 127) / 255);
}

/// The rows and columns of the pixels with some alpha: from the first to behind the last.
struct PixelRange {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool empty() const { return right <= left; }
};
PixelRange filled_range(const Image& image) {
  PixelRange range{image.width, image.height, 0, 0};
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (image.at(c, r)[3] > 0)
        range = {std::min(range.left, c), std::min(range.top, r), std::max(range.right, c + 1),
                 std::max(range.bottom, r + 1)};
  return range;
}

struct PixelOffset {
  int column = 0, row = 0;
};

}  // namespace

LayerInk ink_of(const Layer& layer) {
  return {static_cast<unsigned>(std::lround(255 * std::clamp(layer.opacity, 0.0, 1.0))),
          layer.blending, layer.clipped};
}

void fade(Image& image, const LayerInk& ink) {
  if (ink.opacity == 255) return;
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = static_cast<std::uint8_t>(divided_by_255(image.pixels[i] * ink.opacity));
}

RasterResult composed(RasterResult under, const RasterResult& over, double pixels_per_unit,
                      const LayerInk& ink) {
  // `corner` is the lower left corner of a picture, but rows are counted from the top.
  const auto shift = [&](double by) { return static_cast<int>(std::lround(by * pixels_per_unit)); };
  const int right = shift(over.corner.real() - under.corner.real()),
            up = shift(over.corner.imag() - under.corner.imag());
  int left_edge = 0, bottom_edge = 0, width = under.image.width, height = under.image.height;
  if (!ink.clipped) {
    left_edge = std::min(0, right);
    bottom_edge = std::min(0, up);
    width = std::max(width, right + over.image.width) - left_edge;
    height = std::max(height, up + over.image.height) - bottom_edge;
  }
  constexpr int kLargest = 16384;
  if (width > kLargest || height > kLargest)
    throw Error(ErrorKind::bad_input,
                "the picture would have more than 16384 pixels on a side; choose a smaller scale");
  const auto offset_of = [&](const Image& image, int x, int y) {
    return PixelOffset{x - left_edge, height - (y - bottom_edge) - image.height};
  };
  RasterResult result = std::move(under);
  if (width != result.image.width || height != result.image.height) {
    const PixelOffset at = offset_of(result.image, 0, 0);
    Image larger(width, height);
    for (int r = 0; r < result.image.height; ++r)
      std::memcpy(larger.at(at.column, at.row + r), result.image.at(0, r),
                  4 * static_cast<size_t>(result.image.width));
    result.image = std::move(larger);
    result.corner += Complex(left_edge, bottom_edge) / pixels_per_unit;
  }
  const PixelOffset at = offset_of(over.image, right, up);
  const int rows = std::min(over.image.height, height - at.row),
            columns = std::min(over.image.width, width - at.column);
  for (int r = std::max(0, -at.row); r < rows; ++r)
    for (int c = std::max(0, -at.column); c < columns; ++c)
      blend(over.image.at(c, r), result.image.at(at.column + c, at.row + r), ink);
  return result;
}

Box filled_box(const RasterResult& result, double pixels_per_unit) {
  const PixelRange range = filled_range(result.image);
  Box box;
  if (range.empty()) return box;
  const auto at = [&](int column, int row) {
    return result.corner + Complex(column, result.image.height - row) / pixels_per_unit;
  };
  box.include(at(range.left, range.bottom));
  box.include(at(range.right, range.top));
  return box;
}

RasterResult cropped_to_filled(RasterResult result, double pixels_per_unit) {
  const PixelRange range = filled_range(result.image);
  if (range.empty()) return result;
  RasterResult cropped{
      Image(range.right - range.left, range.bottom - range.top),
      result.corner + Complex(range.left, result.image.height - range.bottom) / pixels_per_unit};
  for (int r = 0; r < cropped.image.height; ++r)
    std::memcpy(cropped.image.at(0, r), result.image.at(range.left, range.top + r),
                4 * static_cast<size_t>(cropped.image.width));
  return cropped;
}

void composite_onto_color(Image& image, const std::array<std::uint8_t, 3>& color) {
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    std::uint8_t pixel[4] = {color[0], color[1], color[2], 255};
    blend(&image.pixels[i], pixel);
    std::memcpy(&image.pixels[i], pixel, 4);
  }
}

}  // namespace holomorph
