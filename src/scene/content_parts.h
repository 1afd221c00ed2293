// The connected parts of a picture's content (8-neighbors), found from its alpha channel.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/cage.h"
#include "scene/cell_grid.h"
#include "scene/formats/image.h"

namespace holomorph {

/// Pixels with an alpha above this belong to the content.
inline constexpr int kOpaqueAlpha = 8;

/// The connected parts of a mask (8-neighbors), the largest first; parts of equal size in the order
/// of their rows.
struct MaskParts {
  std::vector<size_t> sizes;  ///< numbers of cells
  Grid<int> label;            ///< the part of each cell, or -1
};
MaskParts parts_of_mask(const Grid<std::uint8_t>& mask);

/// The pixels with content.
Grid<std::uint8_t> content_of(const Image& image);

/// The largest part, as a mask of width x height bytes with 1 inside. Empty if there is no content.
std::vector<std::uint8_t> largest_part(const Image& image);

/// The boxes in the plane of the parts that a cage leaves out, the largest part first: those with
/// most of their pixels outside. Parts with less than a thousandth of the largest part's pixels are
/// ignored. Empty for a picture without transparency.
std::vector<Box> parts_outside(const Image& image, const Cage& cage);

/// What a user should know about the parts that a cage leaves out; empty if there are none.
std::string left_out_text(size_t parts);

}  // namespace holomorph
