// The parts of a picture's content, each on a grid of cells.
#pragma once

#include "scene/cell_grid.h"
#include "scene/formats/image.h"
#include "scene/limits.h"

namespace holomorph {

/// A part of the content around which a cage is made. A cell covers scale x scale pixels. Lengths
/// are in cells; distances are those between the centers of cells.
struct PartGrid {
  Grid<float> distance;       ///< to the part
  Grid<std::uint8_t> others;  ///< cells with content for which no cage is made
  Grid<float> to_rivals;      ///< the distance to the nearest other part with a cage, or 1e10
  int scale, left, top;       ///< where the picture's first cell is on the grid
  int border;                 ///< empty cells at each side, at least
  Complex upper_left;         ///< corner of the picture in its plane
  double size;                ///< diagonal of the part's box

  /// From cells to the picture's plane, y up.
  Complex in_picture(Complex z) const {
    return upper_left + Complex((z.real() - left + 0.5) * scale, (z.imag() + top - 0.5) * scale);
  }
};

/// Which content is taken: the largest connected part (8-neighbors); all parts that can be seen,
/// joined to one by filling and bridging the gaps between them; or each of them.
enum class PartChoice { largest, joined, apart };

/// Parts with less than this share of the picture's pixels cannot be seen.
inline constexpr double kLeastPart = 0.0005;
/// If there are more, the smallest are left out.
inline constexpr size_t kMostParts = kMaxParts;

/// The chosen parts, the largest first; empty if the picture has no content or no transparency.
/// Around each one, there is room for distances up to `reach` pixels and up to a fraction of its
/// size. Parts less than three cells apart count as one. Cost: about 100 ns per pixel, ten times as
/// much for joined parts.
std::vector<PartGrid> part_grids(const Image& image, PartChoice choice, double fraction,
                                 double reach);

}  // namespace holomorph
