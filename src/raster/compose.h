// Composites pictures over one another.
#pragma once

#include "raster/raster.h"
#include "scene/scene.h"

namespace holomorph {

/// How a layer combines with what is below it. The opacity is that of 8-bit pixels.
struct LayerInk {
  unsigned opacity = 255;
  Blending blending = Blending::normal;
  bool clipped = false;  ///< changes the colors below, but not their alpha
};
LayerInk ink_of(const Layer& layer);

/// Composites `over` onto `under`, in the smallest picture that contains both, in 8-bit straight
/// alpha. Both must have the same resolution, and their corners must be a whole number of pixels
/// apart. Opaque pixels of `over`, and pixels covered by only one of the pictures, are copied bit
/// for bit with the usual ink. With clipped ink, the result is as large as `under`. Throws
/// Error{bad_input} if the result would have more than 16384 pixels on a side.
RasterResult composed(RasterResult under, const RasterResult& over, double pixels_per_unit,
                      const LayerInk& ink = {});
/// Multiplies the alpha of all pixels by the opacity.
void fade(Image& image, const LayerInk& ink);

/// The part of the plane that pixels with some alpha cover; empty if there are none.
Box filled_box(const RasterResult& result, double pixels_per_unit);
/// The smallest part of a picture that contains all pixels with some alpha. A picture without any
/// is returned unchanged.
RasterResult cropped_to_filled(RasterResult result, double pixels_per_unit);

/// Composites the image onto an opaque background color, in place.
void composite_onto_color(Image& image, const std::array<std::uint8_t, 3>& color);

}  // namespace holomorph
