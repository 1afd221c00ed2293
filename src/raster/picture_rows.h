// Draws the pixels of one row that show the source picture through an affine map. The portable code
// is the definition; faster code gives the same bits.
#pragma once

#include "raster/sampler.h"

namespace holomorph {

/// An affine map from output pixels (x right, y down) to source coordinates:
/// u = u0 + ux x + uy y, v = v0 + vx x + vy y. Where it shrinks the picture, `taps_x` times
/// `taps_y` samples are averaged for each pixel.
struct SourceMap {
  double u0 = 0, ux = 1, uy = 0, v0 = 0, vx = 0, vy = 1;
  int taps_x = 1, taps_y = 1;
};

/// What a row's array of slots says about a pixel; numbers from 0 on are silhouette pixels.
inline constexpr int kFree = -1, kInCage = -2;

/// The pixels from column `begin` to `end` - 1 of a row of the output, which has `width` pixels.
struct PixelSpan {
  int row = 0, begin = 0, end = 0, width = 0;
  std::uint8_t* pixels = nullptr;  ///< of column 0 of the row
  const int* slots = nullptr;      ///< of column 0 of the row
  bool outside = false;            ///< leaves out pixels in the rest cage
  /// Whether a pixel is drawn. Silhouette pixels have coverage samples instead.
  bool draws(int column) const {
    return slots[column] == kFree || (slots[column] == kInCage && !outside);
  }
};

/// The color that a pixel of the output shows, in straight alpha.
Float4 source_color(const Image& source, const SourceMap& map, int column, int row);
/// The same, from the source's fine pixels if it has some.
Float4 fine_source_color(const Image& source, const SourceMap& map, int column, int row);

/// How spans are drawn.
struct SpanDrawer {
  /// Composites the source onto the pixels of a span.
  void (*draw)(const Image& source, const SourceMap& map, const PixelSpan& span);
  /// Composites texels onto the pixels of a span, one onto each, without blending them.
  void (*copy)(const std::uint8_t* texels, const PixelSpan& span);
};
void draw_span(const Image& source, const SourceMap& map, const PixelSpan& span);
void copy_span(const std::uint8_t* texels, const PixelSpan& span);
inline constexpr SpanDrawer kPortableSpans{draw_span, copy_span};
/// Code for AVX2 that draws the same bits, if the processor has AVX2; otherwise kPortableSpans.
SpanDrawer span_drawer_avx2();

/// Draws a span by the fastest of these. Rows of texels that keep their distances are copied.
void draw_span_fast(const Image& source, const SourceMap& map, const PixelSpan& span);

}  // namespace holomorph
