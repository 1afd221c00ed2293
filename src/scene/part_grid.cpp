// Gaps are filled by closing: cells within a distance of the content are added, and then those that
// are within the same distance of the rest are taken away.
#include "scene/part_grid.h"

#include <algorithm>
#include <cmath>

#include "scene/content_parts.h"

namespace holomorph {
namespace {

using Mask = Grid<std::uint8_t>;

Mask cells_of(const Image& image, int scale) {
  Mask cells((image.width - 1) / scale + 1, (image.height - 1) / scale + 1, 0);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (image.at(c, r)[3] > kOpaqueAlpha) cells(c / scale, r / scale) = 1;
  return cells;
}

/// A mask with empty cells on all sides, or without some of them if `by` is negative.
Mask padded(const Mask& mask, int by) {
  Mask result(mask.width + 2 * by, mask.height + 2 * by, 0);
  for (int r = std::max(0, -by); r < std::min(mask.height, mask.height + by); ++r)
    for (int c = std::max(0, -by); c < std::min(mask.width, mask.width + by); ++c)
      result(c + by, r + by) = mask(c, r);
  return result;
}

template <class Keep>
Mask where(const Grid<float>& field, Keep keep) {
  Mask mask(field.width, field.height, 0);
  for (size_t i = 0; i < mask.cells.size(); ++i) mask.cells[i] = keep(field.cells[i]);
  return mask;
}

/// The parts of a mask, where parts are the same if their cells are at most 2 `radius` apart.
/// `sizes` are in cells of the mask.
MaskParts parts_within(const Mask& mask, double radius) {
  const int room = static_cast<int>(std::ceil(radius)) + 2;
  const Mask grown =
      where(distance_field(padded(mask, room)), [&](float d) { return d <= radius; });
  MaskParts parts = parts_of_mask(grown);
  std::ranges::fill(parts.sizes, 0);
  Grid<int> label(mask.width, mask.height, -1);
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c) {
      if (!mask(c, r)) continue;
      label(c, r) = parts.label(c + room, r + room);
      ++parts.sizes[static_cast<size_t>(label(c, r))];
    }
  parts.label = std::move(label);
  return parts;
}

Mask closed(const Mask& mask, double radius) {
  const int room = static_cast<int>(std::ceil(radius)) + 2;
  const Grid<float> distance = distance_field(padded(mask, room));
  const Mask around = where(distance, [&](float d) { return d > radius; });
  return padded(where(distance_field(around), [&](float d) { return d > radius; }), -room);
}

/// A mask with the narrowest gaps filled that keep its parts apart.
Mask joined(const Mask& mask) {
  const auto is_one = [](const Mask& m) { return parts_of_mask(m).sizes.size() == 1; };
  if (is_one(mask)) return mask;
  double apart = 0, together = 2;
  while (!is_one(closed(mask, together))) {
    apart = together;
    together *= 2;
  }
  constexpr int kHalves = 3;
  for (int i = 0; i < kHalves && apart > 0; ++i) {
    const double radius = 0.5 * (apart + together);
    (is_one(closed(mask, radius)) ? together : apart) = radius;
  }
  // The bridges are thin where the gap is as wide as it can be.
  constexpr double kWider = 1.5;
  return closed(mask, kWider * together);
}

/// The parts that can be seen, by decreasing size.
std::vector<int> visible_parts(const MaskParts& parts, size_t cells) {
  std::vector<int> numbers;
  for (size_t i = 0; i < parts.sizes.size(); ++i) numbers.push_back(static_cast<int>(i));
  const auto size = [&](int i) { return parts.sizes[static_cast<size_t>(i)]; };
  std::ranges::stable_sort(numbers, std::greater<>{}, size);
  const double least = kLeastPart * static_cast<double>(cells);
  const auto end = std::ranges::find_if(
      numbers, [&](int i) { return i != numbers[0] && static_cast<double>(size(i)) < least; });
  numbers.erase(end, numbers.end());
  if (numbers.size() > kMostParts) numbers.resize(kMostParts);
  return numbers;
}

/// A mask of some parts.
Mask mask_of(const MaskParts& parts, std::span<const int> numbers) {
  std::vector<char> chosen(parts.sizes.size(), 0);
  for (const int i : numbers) chosen[static_cast<size_t>(i)] = 1;
  Mask mask(parts.label.width, parts.label.height, 0);
  for (size_t i = 0; i < mask.cells.size(); ++i)
    mask.cells[i] =
        parts.label.cells[i] >= 0 && chosen[static_cast<size_t>(parts.label.cells[i])] != 0;
  return mask;
}

/// The cells in a box of columns and rows.
Mask cropped(const Mask& mask, const Box& box) {
  const int left = static_cast<int>(box.left), top = static_cast<int>(box.bottom);
  Mask result(static_cast<int>(box.right) + 1 - left, static_cast<int>(box.top) + 1 - top, 0);
  for (int r = 0; r < result.height; ++r)
    for (int c = 0; c < result.width; ++c) result(c, r) = mask(c + left, r + top);
  return result;
}

/// The columns and rows of the set cells.
Box box_of_cells(const Mask& mask) {
  Box box;
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c)
      if (mask(c, r)) box.include(Complex(c, r));
  return box;
}

}  // namespace

std::vector<PartGrid> part_grids(const Image& image, PartChoice choice, double fraction,
                                 double reach) {
  if (is_opaque(image)) return {};
  constexpr int kMostCells = 4096, kMostJoined = 1024;
  const int longest = std::max(image.width, image.height);
  const auto scale_for = [&](int most) { return (longest + most - 1) / most; };
  int scale = scale_for(kMostCells);
  Mask content = cells_of(image, scale);
  constexpr double kTouching = 1.5;  // parts with gaps of two cells are one
  const MaskParts near = parts_within(content, kTouching);
  if (near.sizes.empty()) return {};
  const std::vector<int> visible = visible_parts(near, content.cells.size());
  if (visible.size() == 1) choice = PartChoice::largest;
  std::vector<Mask> masks;
  if (choice == PartChoice::largest) {
    const std::vector<std::uint8_t> pixels = largest_part(image);
    Mask largest(content.width, content.height, 0);
    for (int r = 0; r < image.height; ++r)
      for (int c = 0; c < image.width; ++c)
        if (pixels[static_cast<size_t>(r) * static_cast<size_t>(image.width) +
                   static_cast<size_t>(c)])
          largest(c / scale, r / scale) = 1;
    masks.push_back(std::move(largest));
  } else if (choice == PartChoice::joined) {
    scale = scale_for(kMostJoined);
    content = cells_of(image, scale);
    const MaskParts parts = parts_within(content, kTouching);
    masks.push_back(joined(mask_of(parts, visible_parts(parts, content.cells.size()))));
  } else {
    for (const int part : visible) masks.push_back(mask_of(near, {{part}}));
  }
  Mask taken(content.width, content.height, 0);
  for (const Mask& mask : masks)
    for (size_t i = 0; i < taken.cells.size(); ++i) taken.cells[i] |= mask.cells[i];

  std::vector<PartGrid> grids;
  for (const Mask& mask : masks) {
    const Box box = box_of_cells(mask);
    const double size = box.diagonal() + 1;
    const int border = static_cast<int>(std::ceil(std::max(fraction * size, reach / scale))) + 5;
    // There may be many parts: only the surroundings of each one are looked at.
    const Box window = masks.size() == 1 ? Box{0, 0, mask.width - 1.0, mask.height - 1.0} : box;
    const Mask own = padded(joined(cropped(mask, window)), border);
    const int left = border - static_cast<int>(window.left),
              top = border - static_cast<int>(window.bottom);
    Mask others(own.width, own.height, 0), rivals = others;
    for (int r = 0; r < own.height; ++r)
      for (int c = 0; c < own.width; ++c) {
        const int column = c - left, row = r - top;
        if (column < 0 || row < 0 || column >= mask.width || row >= mask.height || own(c, r))
          continue;
        rivals(c, r) = taken(column, row);
        others(c, r) = content(column, row) && !taken(column, row);
      }
    grids.push_back({distance_field(own), std::move(others), distance_field(rivals), scale, left,
                     top, border, image.height, size});
  }
  return grids;
}

}  // namespace holomorph
