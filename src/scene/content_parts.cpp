// Runs of content in the rows are joined to parts by a union-find forest.
#include "scene/content_parts.h"

#include <algorithm>
#include <functional>
#include <map>

#include "scene/cell_grid.h"

namespace holomorph {
namespace {

/// A run of ones in a row, and its parent in the union-find forest of connected parts.
struct Run {
  int row, begin, end;
  size_t parent;
};

std::vector<Run> runs_of(const Grid<std::uint8_t>& mask) {
  std::vector<Run> runs;
  for (int r = 0; r < mask.height; ++r)
    for (int c = 0; c < mask.width; ++c) {
      if (!mask(c, r)) continue;
      const int begin = c;
      while (c < mask.width && mask(c, r)) ++c;
      runs.push_back({r, begin, c, runs.size()});
    }
  return runs;
}

size_t root_of(std::vector<Run>& runs, size_t run) {
  while (runs[run].parent != run) run = runs[run].parent = runs[runs[run].parent].parent;
  return run;
}

/// The runs of a mask, joined to 8-connected sets.
std::vector<Run> joined_runs_of(const Grid<std::uint8_t>& mask) {
  std::vector<Run> runs = runs_of(mask);
  size_t above = 0;  // the first run of the previous row that may touch this one
  for (size_t i = 0; i < runs.size(); ++i) {
    while (runs[above].row < runs[i].row - 1 ||
           (runs[above].row == runs[i].row - 1 && runs[above].end < runs[i].begin))
      ++above;
    for (size_t j = above; j < i && runs[j].row == runs[i].row - 1 && runs[j].begin <= runs[i].end;
         ++j)
      runs[root_of(runs, i)].parent = root_of(runs, j);
  }
  return runs;
}

}  // namespace

MaskParts parts_of_mask(const Grid<std::uint8_t>& mask) {
  std::vector<Run> runs = joined_runs_of(mask);
  std::map<size_t, size_t> size_of_root;
  for (size_t i = 0; i < runs.size(); ++i)
    size_of_root[root_of(runs, i)] += static_cast<size_t>(runs[i].end - runs[i].begin);
  std::vector<std::pair<size_t, size_t>> roots(size_of_root.begin(), size_of_root.end());
  std::ranges::stable_sort(roots, std::greater<>{}, &std::pair<size_t, size_t>::second);
  MaskParts parts{{}, {mask.width, mask.height, -1}};
  std::map<size_t, int> number_of_root;
  for (const auto& [root, size] : roots) {
    number_of_root[root] = static_cast<int>(parts.sizes.size());
    parts.sizes.push_back(size);
  }
  for (size_t i = 0; i < runs.size(); ++i) {
    const int number = number_of_root.at(root_of(runs, i));
    for (int c = runs[i].begin; c < runs[i].end; ++c) parts.label(c, runs[i].row) = number;
  }
  return parts;
}

Grid<std::uint8_t> content_of(const Image& image) {
  Grid<std::uint8_t> mask(image.width, image.height, 0);
  for (size_t i = 0; i < mask.cells.size(); ++i)
    mask.cells[i] = image.pixels[4 * i + 3] > kOpaqueAlpha;
  return mask;
}

std::vector<std::uint8_t> largest_part(const Image& image) {
  const MaskParts parts = parts_of_mask(content_of(image));
  if (parts.sizes.empty()) return {};
  std::vector<std::uint8_t> mask;
  for (const int label : parts.label.cells) mask.push_back(label == 0);
  return mask;
}

std::vector<Box> parts_outside(const Image& image, const Cage& cage) {
  constexpr size_t kSpeck = 1000;  // parts that are so many times smaller cannot be seen
  if (is_opaque(image)) return {};
  const MaskParts parts = parts_of_mask(content_of(image));
  std::vector<Box> boxes(parts.sizes.size());
  std::vector<size_t> inside(parts.sizes.size(), 0), looked_at = inside, seen = inside;
  const Polygon outline = outline_of(cage);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const int label = parts.label(c, r);
      if (label < 0 || kSpeck * parts.sizes[static_cast<size_t>(label)] < parts.sizes[0]) continue;
      const size_t part = static_cast<size_t>(label);
      const double left = image.left + c, top = image.top() - r;
      boxes[part].include(Complex(left, top - 1));
      boxes[part].include(Complex(left + 1, top));
      constexpr size_t kMost = 100;  // pixels of a part that are looked at
      if (seen[part]++ % (1 + parts.sizes[part] / kMost) != 0) continue;
      ++looked_at[part];
      inside[part] += encloses(outline, Complex(left + 0.5, top - 0.5));
    }
  std::vector<Box> found;
  for (size_t part = 0; part < boxes.size(); ++part)
    if (looked_at[part] > 2 * inside[part]) found.push_back(boxes[part]);
  return found;
}

std::string left_out_text(size_t parts) {
  if (parts == 0) return "";
  return parts == 1 ? "A part of the picture stays outside the cage."
                    : std::to_string(parts) + " parts of the picture stay outside the cage.";
}

}  // namespace holomorph
