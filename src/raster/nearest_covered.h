// For each pixel, the nearest pixel of a given set.
#pragma once

#include <cstddef>
#include <vector>

namespace holomorph {

/// A pixel's column and row.
struct PixelIndex {
  int column = -1, row = -1;  ///< negative: none
};

/// Finds, for each pixel, the nearest one that is covered. 8-neighbor propagation finds it with an
/// error in distance well below a pixel. Cost: linear in the number of pixels.
class NearestCovered {
 public:
  /// `covered` has one entry per pixel, in rows from the top.
  NearestCovered(int width, int height, const std::vector<bool>& covered);

  /// The nearest covered pixel; none if no pixel is covered. A covered pixel is its own nearest.
  PixelIndex at(int column, int row) const { return found_[index(column, row)]; }

 private:
  size_t index(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
  }
  void propagate(int column, int row, int across, int down);

  int width_, height_;
  std::vector<PixelIndex> found_;
};

}  // namespace holomorph
