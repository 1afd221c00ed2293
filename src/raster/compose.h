// Pictures one above the other.
#pragma once

#include "raster/raster.h"

namespace holomorph {

/// The smallest picture that holds both, `over` above `under`, in 8-bit straight alpha. Both have
/// the same pixels per unit and corners a whole number of pixels apart. Where only one of them is,
/// or `over` is opaque, its pixels stay bit for bit. Throws Error{bad_input} for more than 16384
/// pixels a side.
RasterResult composed(RasterResult under, const RasterResult& over, double pixels_per_unit);

/// Pixels above a colour, in place.
void lay_on(Image& image, const std::array<std::uint8_t, 3>& color);

}  // namespace holomorph
