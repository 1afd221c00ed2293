// Values in square cells, and the fields that the automatic cage is made of.
#pragma once

#include <cstdint>

#include "core/types.h"

namespace holomorph {

/// Cells in rows from the top. The center of cell (c, r) is at c - i r in the plane.
template <class T>
struct Grid {
  int width, height;
  std::vector<T> cells;
  Grid(int w, int h, T fill) : width(w), height(h), cells(static_cast<size_t>(w) * h, fill) {}
  T& operator()(int c, int r) { return cells[static_cast<size_t>(r) * width + c]; }
  T operator()(int c, int r) const { return cells[static_cast<size_t>(r) * width + c]; }
};

/// The distance from the center of each cell to the nearest center of a set cell, in cells; 1e10 if
/// no cell is set. Cost: linear.
Grid<float> distance_field(const Grid<std::uint8_t>& mask);

/// The value of a field between the centers of its cells, by bilinear interpolation.
double value_at(const Grid<float>& field, Complex z);

/// The outermost curve {field = level} around the topmost cell with a lower value, as a closed
/// polygon; empty if there is none. Lower values lie to its left. No cell on the grid's border may
/// have a lower value.
Points level_curve(const Grid<float>& field, double level);

}  // namespace holomorph
