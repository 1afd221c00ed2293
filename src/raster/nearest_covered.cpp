// Two sweeps propagate the nearest covered pixel from neighbor to neighbor (Danielsson 1980).
#include "raster/nearest_covered.h"

#include <cstdint>
#include <limits>

namespace holomorph {
namespace {

std::int64_t squared_distance(int column, int row, PixelIndex from) {
  if (from.column < 0) return std::numeric_limits<std::int64_t>::max();
  const std::int64_t across = column - from.column, down = row - from.row;
  return across * across + down * down;
}

}  // namespace

NearestCovered::NearestCovered(int width, int height, const std::vector<bool>& covered)
    : width_(width), height_(height), found_(covered.size()) {
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c)
      if (covered[index(c, r)]) found_[index(c, r)] = {c, r};
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) {
      propagate(c, r, -1, 0);
      for (const int across : {-1, 0, 1}) propagate(c, r, across, -1);
    }
    for (int c = width - 1; c >= 0; --c) propagate(c, r, 1, 0);
  }
  for (int r = height - 1; r >= 0; --r) {
    for (int c = width - 1; c >= 0; --c) {
      propagate(c, r, 1, 0);
      for (const int across : {1, 0, -1}) propagate(c, r, across, 1);
    }
    for (int c = 0; c < width; ++c) propagate(c, r, -1, 0);
  }
}

void NearestCovered::propagate(int column, int row, int across, int down) {
  const int c = column + across, r = row + down;
  if (c < 0 || c >= width_ || r < 0 || r >= height_) return;
  const PixelIndex candidate = at(c, r);
  if (squared_distance(column, row, candidate) < squared_distance(column, row, at(column, row)))
    found_[index(column, row)] = candidate;
}

}  // namespace holomorph
