// Gaps are filled by closing: cells within a distance of the content are added, and then those that
// are within the same distance of the rest are taken away. Wider gaps are bridged.
#include "scene/part_grid.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/polygon.h"
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

/// Adds a bridge of cells between the first part of a mask and the part that is nearest to it.
void add_bridge(Mask& mask, int half_width) {
  const MaskParts parts = parts_of_mask(mask);
  Mask own(mask.width, mask.height, 0);
  for (size_t i = 0; i < own.cells.size(); ++i) own.cells[i] = parts.label.cells[i] == 0;
  const Grid<float> distance = distance_field(own);
  // Among cells that are about as near, the one in their middle.
  const auto for_others = [&](const auto& visit) {
    for (int r = 0; r < mask.height; ++r)
      for (int c = 0; c < mask.width; ++c)
        if (mask(c, r) && !own(c, r)) visit(Complex(c, r), distance(c, r));
  };
  float least = HUGE_VALF;
  for_others([&](Complex, float away) { least = std::min(least, away); });
  Complex sum = 0;
  double count = 0;
  for_others([&](Complex z, float away) {
    if (away <= least + 1) sum += z, ++count;
  });
  Complex to = 0;
  double off = HUGE_VAL;
  for_others([&](Complex z, float away) {
    if (away <= least + 1 && std::abs(z - sum / count) < off)
      off = std::abs(z - sum / count), to = z;
  });
  Complex from = to;
  double shortest = HUGE_VAL;
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c)
      if (const Complex at(c, r); own(c, r) && std::abs(at - to) < shortest)
        shortest = std::abs(at - to), from = at;
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c)
      if (nearest_on_segment(from, to, Complex(c, r)).distance <= half_width) mask(c, r) = 1;
}

/// A mask with narrow gaps filled that keep its parts apart, and with bridges over wider ones.
Mask joined(const Mask& mask) {
  const auto is_one = [](const Mask& m) { return parts_of_mask(m).sizes.size() == 1; };
  if (is_one(mask)) return mask;
  const int longer = std::max(mask.width, mask.height);
  const double widest = std::max(2.0, longer / 6.0);
  double apart = 0, together = 2;
  Mask filled = closed(mask, together);
  while (!is_one(filled) && together < widest) {
    apart = together;
    together = std::min(2 * together, widest);
    filled = closed(mask, together);
  }
  if (!is_one(filled)) {
    const int half_width = 2 + longer / 40;
    while (!is_one(filled)) add_bridge(filled, half_width);
    return filled;
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

/// Fills the empty regions inside a mask that touch cells which `content` does not have: what was
/// left of the gap around a part, such as that between an eye and its pupil.
void fill_gaps(Mask& mask, const Mask& content) {
  Mask empty(mask.width + 2, mask.height + 2, 0);  // with a border that is outside
  for (int r = 0; r < empty.height; ++r)
    for (int c = 0; c < empty.width; ++c)
      empty(c, r) = c == 0 || r == 0 || c > mask.width || r > mask.height || !mask(c - 1, r - 1);
  const MaskParts regions = parts_of_mask(empty);
  std::vector<char> is_gap(regions.sizes.size(), 0);
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c) {
      if (!mask(c, r) || content(c, r)) continue;
      for (const int down : {-1, 0, 1})
        for (const int right : {-1, 0, 1})
          if (const int region = regions.label(c + 1 + right, r + 1 + down); region >= 0)
            is_gap[static_cast<size_t>(region)] = 1;
    }
  is_gap[static_cast<size_t>(regions.label(0, 0))] = 0;
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c)
      if (const int region = regions.label(c + 1, r + 1);
          region >= 0 && is_gap[static_cast<size_t>(region)] != 0)
        mask(c, r) = 1;
}

/// The cells with a label in a box of columns and rows.
Mask cropped(const Grid<int>& labels, const Box& box, int label) {
  const int left = static_cast<int>(box.left), top = static_cast<int>(box.bottom);
  Mask result(static_cast<int>(box.right) + 1 - left, static_cast<int>(box.top) + 1 - top, 0);
  for (int r = 0; r < result.height; ++r)
    for (int c = 0; c < result.width; ++c) result(c, r) = labels(c + left, r + top) == label;
  return result;
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
  // Specks that nearly touch the only part that can be seen do not change its outline.
  const MaskParts pieces = parts_of_mask(content);
  if (visible_parts(pieces, content.cells.size()).size() == 1) choice = PartChoice::largest;
  // What each cage goes around, by the numbers in `labels`; other cells have -1.
  Grid<int> labels = near.label;
  std::vector<int> chosen = visible;
  if (choice == PartChoice::largest) {
    const std::vector<std::uint8_t> pixels = largest_part(image);
    std::ranges::fill(labels.cells, -1);
    chosen = {0};
    for (int r = 0; r < image.height; ++r)
      for (int c = 0; c < image.width; ++c)
        if (pixels[static_cast<size_t>(r) * static_cast<size_t>(image.width) +
                   static_cast<size_t>(c)])
          labels(c / scale, r / scale) = 0;
  } else if (choice == PartChoice::joined) {
    scale = scale_for(kMostJoined);
    content = cells_of(image, scale);
    const MaskParts parts = parts_within(content, kTouching);
    const Mask seen = mask_of(parts, visible_parts(parts, content.cells.size()));
    Mask all = joined(seen);
    fill_gaps(all, seen);
    labels = Grid<int>(all.width, all.height, -1);
    chosen = {0};
    for (size_t i = 0; i < all.cells.size(); ++i) labels.cells[i] = all.cells[i] - 1;
  }
  std::vector<Box> boxes(near.sizes.size() + 1);
  for (int r = 0; r < labels.height; ++r)
    for (int c = 0; c < labels.width; ++c)
      if (labels(c, r) >= 0) boxes[static_cast<size_t>(labels(c, r))].include(Complex(c, r));
  std::vector<char> is_chosen(boxes.size(), 0);
  for (const int part : chosen) is_chosen[static_cast<size_t>(part)] = 1;

  std::vector<PartGrid> grids;
  for (const int part : chosen) {
    const Box box = boxes[static_cast<size_t>(part)];
    const double size = box.diagonal() + 1;
    const int border = static_cast<int>(std::ceil(std::max(fraction * size, reach / scale))) + 5;
    // There may be many parts: only the surroundings of each one are looked at.
    const Box window =
        chosen.size() == 1 ? Box{0, 0, labels.width - 1.0, labels.height - 1.0} : box;
    const Mask own = padded(joined(cropped(labels, window, part)), border);
    const int left = border - static_cast<int>(window.left),
              top = border - static_cast<int>(window.bottom);
    Mask others(own.width, own.height, 0), rivals = others;
    for (int r = 0; r < own.height; ++r)
      for (int c = 0; c < own.width; ++c) {
        const int column = c - left, row = r - top;
        if (column < 0 || row < 0 || column >= labels.width || row >= labels.height || own(c, r))
          continue;
        const int label = labels(column, row);
        rivals(c, r) = label >= 0 && is_chosen[static_cast<size_t>(label)] != 0;
        others(c, r) = content(column, row) && !rivals(c, r);
      }
    grids.push_back({distance_field(own), std::move(others), distance_field(rivals), scale, left,
                     top, border, Complex(image.left, image.top()), size});
  }
  return grids;
}

}  // namespace holomorph
