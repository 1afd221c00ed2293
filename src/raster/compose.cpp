// A picture that nothing is composited with keeps its bits. All others become floating-point
// // numbers until the end, because the rounding of many faint layers would be visible.
#include "raster/compose.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

/// x / 255, rounded, for 0 <= x <= 255^2.
unsigned divided_by_255(unsigned x) {
  return (x + 127) / 255;
}

/// The color channel that a blending mode makes of the colors above and below. 1 is white. Up to
/// there, the formulas are those of W3C; they continue without jumps for what is brighter.
float blended(Blending mode, float over, float under) {
  switch (mode) {
    case Blending::multiply:
      return over * under;
    case Blending::screen:
      return over > 1 || under > 1 ? std::max(over, under) : over + under - over * under;
    case Blending::overlay:
      if (under > 1) return under;
      return under < 0.5f ? 2 * over * under : 1 - 2 * (1 - over) * (1 - under);
    case Blending::add:
      return std::max({std::min(1.0f, over + under), over, under});
    case Blending::normal:
      break;
  }
  return over;
}

/// Multiplies the alpha of all pixels by the opacity.
void fade(Image& image, const LayerInk& ink) {
  if (ink.opacity == 255) return;
  for (size_t i = 3; i < image.fine.size(); i += 4)
    image.fine[i] *= static_cast<float>(ink.opacity) / 255;
  if (!image.fine.empty()) return round_fine(image);
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    image.pixels[i] = static_cast<std::uint8_t>(divided_by_255(image.pixels[i] * ink.opacity));
}

/// Blends one pixel onto another (W3C Compositing and Blending, 5.6, 9.1.3). Clipped ink is
/// blended as if the base were opaque, as in painting programs. If the part of the base that is
/// transparent showed the ink unblended, Multiply would draw light fringes on soft, dark edges.
void blend_pixel(const std::array<float, 4>& over, std::array<float, 4>& under,
                 const LayerInk& ink) {
  const float opacity = static_cast<float>(ink.opacity) / 255, a = over[3] * opacity, b = under[3];
  if (a <= 0 || (ink.clipped && b <= 0)) return;
  const float alone = ink.clipped ? 0 : 1 - b;  // the part of `over` with nothing below it
  if (ink.blending == Blending::normal) {
    for (size_t k = 0; k < 3; ++k) under[k] = (alone + b) * opacity * over[k] + (1 - a) * under[k];
  } else {
    for (size_t k = 0; k < 3; ++k) {
      const float cs = over[k] / over[3],
                  mixed = b > 0 ? blended(ink.blending, cs, under[k] / b) : cs;
      under[k] = a * (alone * cs + b * mixed) + (1 - a) * under[k];
    }
  }
  if (!ink.clipped) under[3] = a + b - a * b;
}

/// How many whole pixels lie between the lower left corners of two pictures.
struct Shift {
  int right = 0, up = 0;
};
Shift shift_between(Complex from, Complex to, double pixels_per_unit) {
  const Complex by = (to - from) * pixels_per_unit;
  return {static_cast<int>(std::lround(by.real())), static_cast<int>(std::lround(by.imag()))};
}

/// The background, cut to the gaps of a picture: together, they have the larger alpha of the two.
RasterResult cut_to_gaps(RasterResult background, const RasterResult& picture,
                         double pixels_per_unit) {
  const Shift shift = shift_between(picture.corner, background.corner, pixels_per_unit);
  Image& image = background.image;
  const Image& over = picture.image;
  const int top = over.height - shift.up - image.height;
  const auto fill = [](float alpha, float covered) {
    return covered >= 1 ? 0 : std::max(0.0f, alpha - covered) / (1 - covered);
  };
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const int row = top + r, column = shift.right + c;
      if (row < 0 || row >= over.height || column < 0 || column >= over.width) continue;
      const size_t at = image.index(c, r) + 3, there = over.index(column, row) + 3;
      const float covered =
          (over.fine.empty() ? static_cast<float>(over.pixels[there]) : over.fine[there]) / 255;
      if (!image.fine.empty()) image.fine[at] = 255 * fill(image.fine[at] / 255, covered);
      image.pixels[at] = static_cast<std::uint8_t>(
          255 * fill(static_cast<float>(image.pixels[at]) / 255, covered) + 0.5f);
    }
  return background;
}

}  // namespace

LayerInk ink_of(const Scene& scene, size_t layer) {
  const Layer& it = *scene.layers[layer];
  return {static_cast<unsigned>(std::lround(255 * std::clamp(it.opacity, 0.0, 1.0))), it.blending,
          clip_base(scene, layer).has_value()};
}

Composition::Layer Composition::layer_of(const RasterResult& picture) {
  const Image& image = picture.image;
  Layer layer{image.width, image.height, picture.corner, {}};
  layer.pixels.resize(image.pixels.size() / 4);
  const auto take = [&](const auto* from) {
    for (Pixel& pixel : layer.pixels) {
      const float alpha = static_cast<float>(from[3]) / 255;
      for (size_t k = 0; k < 3; ++k) pixel[k] = alpha * (static_cast<float>(from[k]) / 255);
      pixel[3] = alpha;
      from += 4;
    }
  };
  if (image.fine.empty())
    take(image.pixels.data());
  else
    take(image.fine.data());
  return layer;
}

void Composition::add(RasterResult picture, const LayerInk& ink) {
  is_fine_ |= !picture.image.fine.empty();
  if (ink.clipped) {
    check(base_.has_value(), "Composition: the first picture is not clipped");
    if (!group_) group_ = layer_of(*base_);
    return blend(layer_of(picture), *group_, ink);
  }
  if (base_) below_ = take_all();
  base_ = std::move(picture);
  base_ink_ = ink;
}

Composition::Layer Composition::take_all() {
  const Layer over = group_ ? std::move(*group_) : layer_of(*base_);
  Layer under = below_ ? std::move(*below_) : Layer{0, 0, over.corner, {}};
  group_.reset();
  enlarge(under, over);
  blend(over, under, base_ink_);
  return under;
}

RasterResult Composition::result() && {
  check(base_.has_value(), "Composition: there is a picture");
  if (!below_ && !group_) {
    RasterResult only = std::move(*base_);
    fade(only.image, base_ink_);
    return only;
  }
  return straight(take_all());
}

RasterResult Composition::over(Composition background) && {
  const Layer above = take_all();
  Layer all = background.take_all();
  is_fine_ |= background.is_fine_;
  enlarge(all, above);
  blend(above, all, {});
  return straight(all);
}

RasterResult Composition::straight(const Layer& layer) const {
  RasterResult result{Image(layer.width, layer.height), layer.corner};
  if (is_fine_) {
    result.image.fine.reserve(result.image.pixels.size());
    for (const Pixel& from : layer.pixels) {
      for (size_t k = 0; k < 3; ++k)
        result.image.fine.push_back(from[3] > 0 ? 255 * (from[k] / from[3]) : 0);
      result.image.fine.push_back(255 * from[3]);
    }
    round_fine(result.image);
    return result;
  }
  for (size_t i = 0; i < layer.pixels.size(); ++i) {
    const Pixel& from = layer.pixels[i];
    std::uint8_t* to = &result.image.pixels[4 * i];
    to[3] = static_cast<std::uint8_t>(255 * from[3] + 0.5f);
    if (to[3] == 0) continue;
    for (size_t k = 0; k < 3; ++k)
      to[k] = static_cast<std::uint8_t>(std::min(255.0f, 255 * (from[k] / from[3]) + 0.5f));
  }
  return result;
}

void Composition::enlarge(Layer& under, const Layer& over) const {
  // Corners are those at the lower left, but rows are counted from the top.
  const Shift shift = shift_between(under.corner, over.corner, pixels_per_unit_);
  const int left_edge = std::min(0, shift.right), bottom_edge = std::min(0, shift.up);
  const int width = std::max(under.width, shift.right + over.width) - left_edge,
            height = std::max(under.height, shift.up + over.height) - bottom_edge;
  constexpr int kLargest = 16384;
  if (width > kLargest || height > kLargest)
    throw Error(ErrorKind::bad_input,
                "the picture would have more than 16384 pixels on a side; choose a smaller scale");
  if (width == under.width && height == under.height) return;
  Layer larger{
      width, height, under.corner + Complex(left_edge, bottom_edge) / pixels_per_unit_, {}};
  larger.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  const int top = height + bottom_edge - under.height;
  for (int r = 0; r < under.height; ++r)
    std::copy_n(under.pixels.begin() + static_cast<long>(r) * under.width, under.width,
                larger.pixels.begin() + static_cast<long>(top + r) * width - left_edge);
  under = std::move(larger);
}

void Composition::blend(const Layer& over, Layer& under, const LayerInk& ink) const {
  const Shift shift = shift_between(under.corner, over.corner, pixels_per_unit_);
  const int left = shift.right, top = under.height - shift.up - over.height;
  const int rows = std::min(over.height, under.height - top),
            columns = std::min(over.width, under.width - left);
  for (int r = std::max(0, -top); r < rows; ++r) {
    const Pixel* from = &over.pixels[static_cast<size_t>(r) * static_cast<size_t>(over.width)];
    Pixel* to = &under.pixels[static_cast<size_t>(top + r) * static_cast<size_t>(under.width)];
    for (int c = std::max(0, -left); c < columns; ++c) blend_pixel(from[c], to[left + c], ink);
  }
}

void LayerStack::add(RasterResult picture, const LayerInk& ink,
                     std::optional<RasterResult> original) {
  if (shown_ == Originals::whole) {
    if (original) originals_.add(std::move(*original), ink);
  } else {
    if (!ink.clipped) {
      end_group();
      blending_ = ink.blending;
    }
    const bool has_gaps = original && !ink.clipped;
    if (original && (has_gaps || !group_.empty()))
      originals_of_group_.add(std::move(*original), ink);
    if (has_gaps || !group_.empty()) group_.add(picture, ink);
  }
  layers_.add(std::move(picture), ink);
}

void LayerStack::end_group() {
  if (group_.empty()) return;
  RasterResult gaps = cut_to_gaps(std::move(originals_of_group_).result(),
                                  std::move(group_).result(), pixels_per_unit_);
  if (!filled_range(gaps.image).empty())
    originals_.add(cropped_to_filled(std::move(gaps), pixels_per_unit_), {255, blending_});
  group_ = originals_of_group_ = Composition(pixels_per_unit_);
}

std::optional<RasterResult> LayerStack::behind() && {
  end_group();
  if (originals_.empty()) return {};
  return std::move(originals_).result();
}

RasterResult LayerStack::result() && {
  end_group();
  if (originals_.empty()) return std::move(layers_).result();
  return std::move(layers_).over(std::move(originals_));
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
  return {
      cut_out(result.image, range.left, range.top, range.right - range.left,
              range.bottom - range.top),
      result.corner + Complex(range.left, result.image.height - range.bottom) / pixels_per_unit};
}

void composite_onto_color(Image& image, const std::array<std::uint8_t, 3>& color) {
  for (size_t i = 0; i < image.fine.size(); i += 4) {
    float* pixel = &image.fine[i];
    const float alpha = pixel[3] / 255;
    for (size_t k = 0; k < 3; ++k)
      pixel[k] = alpha * pixel[k] + (1 - alpha) * static_cast<float>(color[k]);
    pixel[3] = 255;
  }
  if (!image.fine.empty()) return round_fine(image);
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    std::uint8_t* pixel = &image.pixels[i];
    const unsigned alpha = pixel[3];
    for (size_t k = 0; k < 3; ++k)
      pixel[k] =
          static_cast<std::uint8_t>(divided_by_255(alpha * pixel[k] + (255 - alpha) * color[k]));
    pixel[3] = 255;
  }
}

}  // namespace holomorph
