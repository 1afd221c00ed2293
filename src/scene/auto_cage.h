// Builds a cage around a picture's content from its alpha channel.
#pragma once

#include "core/geometry/cage.h"
#include "scene/formats/image.h"

namespace holomorph {

/// Pixels with an alpha above this belong to the content.
inline constexpr int kOpaqueAlpha = 8;

struct AutoCageOptions {
  int vertices = 30;    ///< requested number of cage vertices, 3 to 500
  double margin = -1;   ///< distance from the content in pixels; negative: 2 % of the longer side
  bool curved = false;  ///< cubic segments instead of straight edges
};

/// A simple counter-clockwise cage around the largest connected part of a picture's content
/// (8-neighbors). The cage encloses all pixels of that part at a distance of about `margin`. It has
/// about the requested number of vertices, or more if fewer would cut into the content. If the
/// picture has no transparency or no content, the cage is a rectangle around the picture. Throws
/// Error for options out of range. Cost: a few ns per pixel, plus about 50 ms for the outline on a
/// grid of at most 768 cells per side.
Cage auto_cage(const Image& image, const AutoCageOptions& options = {});

/// The largest connected part of the content, as a mask of width x height bytes with 1 inside.
/// Empty if there is no content.
std::vector<std::uint8_t> largest_part(const Image& image);

}  // namespace holomorph
