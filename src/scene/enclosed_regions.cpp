#include "scene/enclosed_regions.h"

#include <algorithm>
#include <array>
#include <utility>

namespace holomorph {
namespace {

constexpr std::array<std::pair<int, int>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

using Cell = std::pair<int, int>;

/// The cells that are connected with `start` and for which `is_in` holds. Clears their marks.
template <class IsIn>
std::vector<Cell> connected(Cell start, Grid<std::uint8_t>& marks, IsIn is_in) {
  std::vector<Cell> cells{start};
  marks(start.first, start.second) = 0;
  for (size_t at = 0; at < cells.size(); ++at)
    for (const auto& [right, down] : kSides) {
      const int c = cells[at].first + right, r = cells[at].second + down;
      if (c < 0 || r < 0 || c >= marks.width || r >= marks.height || !marks(c, r) || !is_in(c, r))
        continue;
      marks(c, r) = 0;
      cells.emplace_back(c, r);
    }
  return cells;
}

EnclosedRegion region_of(const std::vector<Cell>& cells, const Grid<float>& distance) {
  int left = distance.width, right = 0, top = distance.height, bottom = 0;
  for (const auto& [c, r] : cells) {
    left = std::min(left, c), right = std::max(right, c);
    top = std::min(top, r), bottom = std::max(bottom, r);
  }
  constexpr int kBorder = 2;
  EnclosedRegion region{
      left - kBorder, top - kBorder,
      Grid<float>(right - left + 1 + 2 * kBorder, bottom - top + 1 + 2 * kBorder, 0.0f)};
  for (const auto& [c, r] : cells) {
    region.depth(c - region.column, r - region.row) = distance(c, r);
    region.deepest = std::max(region.deepest, static_cast<double>(distance(c, r)));
  }
  return region;
}

}  // namespace

Points EnclosedRegion::curve(double level) const {
  const auto deep = std::ranges::max_element(depth.cells) - depth.cells.begin();
  Grid<std::uint8_t> marks(depth.width, depth.height, 1);
  Grid<float> field(depth.width, depth.height, 0.0f);  // lower inside
  const auto is_deep = [&](int c, int r) { return depth(c, r) > level; };
  for (const auto& [c, r] :
       connected({static_cast<int>(deep) % depth.width, static_cast<int>(deep) / depth.width},
                 marks, is_deep)) {
    field(c, r) = -depth(c, r);
    for (const auto& [right, down] : kSides)  // the curve runs between these cells
      if (!is_deep(c + right, r + down)) field(c + right, r + down) = -depth(c + right, r + down);
  }
  Points curve = level_curve(field, -level);
  for (Complex& z : curve) z += Complex(column, -row);
  return curve;
}

std::vector<EnclosedRegion> enclosed_regions(const Grid<float>& distance,
                                             const Grid<std::uint8_t>& taken, double least) {
  Grid<std::uint8_t> marks(distance.width, distance.height, 0);
  for (size_t i = 0; i < marks.cells.size(); ++i) marks.cells[i] = distance.cells[i] > 0 ? 1 : 0;
  const auto all = [](int, int) { return true; };
  connected({0, 0}, marks, all);  // the outside; the grid's border is empty
  std::vector<EnclosedRegion> regions;
  for (int r = 0; r < marks.height; ++r)
    for (int c = 0; c < marks.width; ++c) {
      if (!marks(c, r)) continue;
      const std::vector<Cell> cells = connected({c, r}, marks, all);
      if (std::ranges::any_of(cells, [&](const Cell& at) { return taken(at.first, at.second); }))
        continue;
      EnclosedRegion region = region_of(cells, distance);
      if (region.deepest >= least) regions.push_back(std::move(region));
    }
  std::ranges::sort(regions, std::ranges::greater{}, &EnclosedRegion::deepest);
  return regions;
}

}  // namespace holomorph
