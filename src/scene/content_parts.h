// The connected parts of a picture's content (8-neighbors), found from its alpha channel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/curve.h"
#include "scene/formats/image.h"

namespace holomorph {

/// Pixels with an alpha above this belong to the content.
inline constexpr int kOpaqueAlpha = 8;

/// The largest part, as a mask of width x height bytes with 1 inside. Empty if there is no content.
std::vector<std::uint8_t> largest_part(const Image& image);

/// The boxes in the plane of the other parts, the largest part first. Parts with less than a
/// thousandth of the largest part's pixels are ignored. Empty for a picture without transparency.
std::vector<Box> smaller_parts(const Image& image);

/// What a user should know about the parts that a cage around the largest part leaves out; empty if
/// there are none.
std::string left_out_text(size_t parts);

}  // namespace holomorph
