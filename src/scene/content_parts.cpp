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

/// The parts of a mask. Each run belongs to the part that its root stands for.
struct Parts {
  std::vector<Run> runs;
  std::vector<size_t> sizes;  ///< number of cells, at the indices of the roots
  size_t largest = 0;         ///< its root; 0 if there are no runs

  explicit Parts(const Grid<std::uint8_t>& mask) : runs(joined_runs_of(mask)) {
    sizes.assign(runs.size(), 0);
    for (size_t i = 0; i < runs.size(); ++i)
      sizes[root(i)] += static_cast<size_t>(runs[i].end - runs[i].begin);
    if (!runs.empty())
      largest = static_cast<size_t>(std::ranges::max_element(sizes) - sizes.begin());
  }
  size_t root(size_t run) { return root_of(runs, run); }
};

Grid<std::uint8_t> content_of(const Image& image) {
  Grid<std::uint8_t> mask(image.width, image.height, 0);
  for (size_t i = 0; i < mask.cells.size(); ++i)
    mask.cells[i] = image.pixels[4 * i + 3] > kOpaqueAlpha;
  return mask;
}

}  // namespace

std::vector<std::uint8_t> largest_part(const Image& image) {
  Grid<std::uint8_t> mask = content_of(image);
  Parts parts(mask);
  for (size_t i = 0; i < parts.runs.size(); ++i)
    if (const Run& run = parts.runs[i]; parts.root(i) != parts.largest)
      for (int c = run.begin; c < run.end; ++c) mask(c, run.row) = 0;
  return parts.runs.empty() ? std::vector<std::uint8_t>{} : std::move(mask.cells);
}

std::vector<Box> smaller_parts(const Image& image) {
  constexpr size_t kSpeck = 1000;  // parts that are so many times smaller cannot be seen
  if (is_opaque(image)) return {};
  Parts parts(content_of(image));
  std::map<size_t, Box> boxes;
  for (size_t i = 0; i < parts.runs.size(); ++i) {
    const size_t root = parts.root(i);
    if (root == parts.largest || kSpeck * parts.sizes[root] < parts.sizes[parts.largest]) continue;
    const Run& run = parts.runs[i];
    const double top = image.height - run.row;
    boxes[root].include(Complex(run.begin, top - 1));
    boxes[root].include(Complex(run.end, top));
  }
  std::vector<std::pair<size_t, Box>> by_size;
  for (const auto& [root, box] : boxes) by_size.emplace_back(parts.sizes[root], box);
  std::ranges::stable_sort(by_size, std::greater<>{}, &std::pair<size_t, Box>::first);
  std::vector<Box> found;
  for (const auto& [size, box] : by_size) found.push_back(box);
  return found;
}

std::string left_out_text(size_t parts) {
  if (parts == 0) return "";
  return "The cage holds the largest part; " +
         (parts == 1 ? "another part of the picture stays"
                     : std::to_string(parts) + " other parts of the picture stay") +
         " outside.";
}

}  // namespace holomorph
