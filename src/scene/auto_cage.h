// Builds a cage around a picture's content from its alpha channel.
#pragma once

#include <optional>

#include "core/geometry/cage.h"
#include "scene/formats/image.h"

namespace holomorph {

/// Pixels with an alpha above this belong to the content.
inline constexpr int kOpaqueAlpha = 8;

struct AutoCageOptions {
  std::optional<int> vertices = {};   ///< 3 to 500; none: as many as the shape needs
  std::optional<double> margin = {};  ///< distance from the content in pixels; none: see `detail`
  double detail = 50;                 ///< 0 to 100: a close cage of many vertices at 100
  bool curved = false;                ///< cubic segments instead of straight edges
};

/// A simple counter-clockwise cage around the largest connected part of a picture's content
/// (8-neighbors), which encloses all pixels of that part. Without a given margin, it follows the
/// content at about 0.5 % of its size (a quarter or four times as much at the ends of `detail`),
/// but no farther than a third of the narrowest gap between limbs, and at least 0.5 px. Limbs that
/// are 3 px apart thus stay apart, unless that takes more than 500 vertices. Curved cages stay
/// farther away and may join limbs. With given vertices, the cage has about that many, or more if
/// fewer would cut into the content; gaps may then be closed. If the picture has no transparency or
/// no content, the cage is the picture's rectangle. Throws Error for options out of range. Cost:
/// about 100 ns per pixel; pictures with sides above 4096 px are reduced.
Cage auto_cage(const Image& image, const AutoCageOptions& options = {});

/// The largest connected part of the content, as a mask of width x height bytes with 1 inside.
/// Empty if there is no content.
std::vector<std::uint8_t> largest_part(const Image& image);

/// The boxes in the plane of the content's other connected parts, the largest first. Parts with
/// less than a thousandth of the largest part's pixels are ignored. Empty for a picture without
/// transparency.
std::vector<Box> smaller_parts(const Image& image);

}  // namespace holomorph
