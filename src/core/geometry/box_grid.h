// A box divided into equal cells, for finding what lies near a point.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types.h"

namespace holomorph {

/// The cells are numbered row by row. Value type.
struct BoxGrid {
  BoxGrid() = default;
  /// About `cells` square cells.
  BoxGrid(const Box& whole, size_t cells) : box(whole) {
    const double side =
        std::sqrt(std::max(box.width() * box.height(), 1e-300) / static_cast<double>(cells + 1));
    constexpr double kMost = 4096;
    columns = static_cast<int>(std::clamp(box.width() / side, 1.0, kMost));
    rows = static_cast<int>(std::clamp(box.height() / side, 1.0, kMost));
  }

  size_t size() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }

  /// The cell of a point, or the nearest cell of a point outside.
  size_t cell_of(Complex z) const {
    const auto index = [](double x, double low, double width, int cells) {
      return static_cast<size_t>(
          std::clamp((x - low) / std::max(width, 1e-300) * cells, 0.0, cells - 1.0));
    };
    return index(z.imag(), box.bottom, box.height(), rows) * static_cast<size_t>(columns) +
           index(z.real(), box.left, box.width(), columns);
  }

  /// Calls `visit` with each cell that a box touches.
  template <class Visit>
  void for_each_cell(const Box& touched, Visit visit) const {
    const size_t width = static_cast<size_t>(columns),
                 low = cell_of({touched.left, touched.bottom}),
                 high = cell_of({touched.right, touched.top});
    for (size_t r = low / width; r <= high / width; ++r)
      for (size_t c = low % width; c <= high % width; ++c) visit(r * width + c);
  }

  Box box;
  int columns = 1, rows = 1;
};

}  // namespace holomorph
