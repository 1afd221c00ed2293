// The offset outline is a level curve of the content's distance field, traced by marching squares.
// simplified_around() then simplifies the outline. The result still encloses a lower level curve,
// which in turn encloses the content.
#include "scene/auto_cage.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/geometry/curve_around.h"
#include "core/geometry/simplify.h"

namespace holomorph {
namespace {

/// A grid of bytes or distances with a border around it.
template <class T>
struct Grid {
  int width, height;
  std::vector<T> cells;
  Grid(int w, int h, T fill) : width(w), height(h), cells(static_cast<size_t>(w) * h, fill) {}
  T& operator()(int c, int r) { return cells[static_cast<size_t>(r) * width + c]; }
  T operator()(int c, int r) const { return cells[static_cast<size_t>(r) * width + c]; }
};

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

/// Clears all ones outside the largest 8-connected set.
void keep_largest_part(Grid<std::uint8_t>& mask) {
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
  std::vector<size_t> sizes(runs.size(), 0);
  for (size_t i = 0; i < runs.size(); ++i)
    sizes[root_of(runs, i)] += static_cast<size_t>(runs[i].end - runs[i].begin);
  const size_t best =
      static_cast<size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  for (size_t i = 0; i < runs.size(); ++i)
    if (root_of(runs, i) != best)
      for (int c = runs[i].begin; c < runs[i].end; ++c) mask(c, runs[i].row) = 0;
}

Grid<std::uint8_t> content_of(const Image& image) {
  Grid<std::uint8_t> mask(image.width, image.height, 0);
  for (size_t i = 0; i < mask.cells.size(); ++i)
    mask.cells[i] = image.pixels[4 * i + 3] > kOpaqueAlpha;
  return mask;
}

/// Computes one line of the exact squared Euclidean distance transform as the lower envelope of
/// parabolas.
void transform_line(const std::vector<double>& f, std::vector<double>& d, std::vector<int>& site,
                    std::vector<double>& bound) {
  const int n = static_cast<int>(f.size());
  int k = -1;
  for (int q = 0; q < n; ++q) {
    if (f[q] >= 1e20) continue;
    double s = -1e20;
    while (k >= 0) {
      const int p = site[k];
      s = ((f[q] + static_cast<double>(q) * q) - (f[p] + static_cast<double>(p) * p)) /
          (2.0 * (q - p));
      if (s > bound[k]) break;
      --k;
    }
    site[++k] = q;
    bound[k] = k == 0 ? -1e20 : s;
    bound[k + 1] = 1e20;
  }
  if (k < 0) return void(std::fill(d.begin(), d.end(), 1e20));
  for (int q = 0, i = 0; q < n; ++q) {
    while (bound[i + 1] < q) ++i;
    d[q] = (q - site[i]) * static_cast<double>(q - site[i]) + f[site[i]];
  }
}

/// The distance from the center of each cell to the nearest center of a set cell, in cells.
Grid<double> distance_field(const Grid<std::uint8_t>& mask) {
  Grid<double> field(mask.width, mask.height, 1e20);
  const int longest = std::max(mask.width, mask.height);
  std::vector<double> f, d, bound(longest + 2);
  std::vector<int> site(longest + 1);
  for (int c = 0; c < mask.width; ++c) {
    f.assign(mask.height, 1e20), d.assign(mask.height, 0);
    for (int r = 0; r < mask.height; ++r) f[r] = mask(c, r) ? 0 : 1e20;
    transform_line(f, d, site, bound);
    for (int r = 0; r < mask.height; ++r) field(c, r) = d[r];
  }
  for (int r = 0; r < mask.height; ++r) {
    f.assign(mask.width, 0), d.assign(mask.width, 0);
    for (int c = 0; c < mask.width; ++c) f[c] = field(c, r);
    transform_line(f, d, site, bound);
    for (int c = 0; c < mask.width; ++c) field(c, r) = std::sqrt(d[c]);
  }
  return field;
}

/// The level curve {field = level} with the largest area, as a closed polygon. Lower values lie to
/// the left of the curve. The center of cell (c, r) is at c - i r, and r increases downwards.
Points level_curve(const Grid<double>& field, double level) {
  // Crossings are numbered by the grid edge on which they lie: horizontal edges first, then
  // vertical ones.
  const int w = field.width, h = field.height;
  const auto horizontal = [&](int c, int r) { return r * w + c; };
  const auto vertical = [&](int c, int r) { return w * h + r * w + c; };
  std::vector<int> next(static_cast<size_t>(2) * w * h, -1);
  const auto inside = [&](int c, int r) { return field(c, r) < level; };
  for (int r = 0; r + 1 < h; ++r)
    for (int c = 0; c + 1 < w; ++c) {
      // Counter-clockwise from the lower left corner. Rows are counted from the top.
      const bool corner[4] = {inside(c, r + 1), inside(c + 1, r + 1), inside(c + 1, r),
                              inside(c, r)};
      const int edge[4] = {horizontal(c, r + 1), vertical(c + 1, r), horizontal(c, r),
                           vertical(c, r)};
      int leaving[2], entering[2], outs = 0, ins = 0;
      for (int k = 0; k < 4; ++k) {
        if (corner[k] && !corner[(k + 1) % 4])
          entering[ins++] = k;  // the curve enters the cell here
        if (!corner[k] && corner[(k + 1) % 4]) leaving[outs++] = k;
      }
      for (int k = 0; k < ins; ++k) {
        // At a saddle, the two inside corners are connected. Therefore each entry is joined to the
        // exit that precedes it around the cell.
        int to = leaving[0];
        if (ins == 2) to = leaving[0] == (entering[k] + 3) % 4 ? leaving[1] : leaving[0];
        next[edge[entering[k]]] = edge[to];
      }
    }
  const auto place = [&](int crossing) {
    const bool is_vertical = crossing >= w * h;
    const int at = is_vertical ? crossing - w * h : crossing, c = at % w, r = at / w;
    const double a = field(c, r), b = is_vertical ? field(c, r + 1) : field(c + 1, r);
    const double t = std::clamp((level - a) / (b - a), 0.0, 1.0);
    return is_vertical ? Complex(c, -(r + t)) : Complex(c + t, -r);
  };
  Points longest;
  for (size_t start = 0; start < next.size(); ++start) {
    if (next[start] < 0) continue;
    Points loop;
    for (int at = static_cast<int>(start); at >= 0;) {
      const Complex z = place(at);
      if (loop.empty() || z != loop.back()) loop.push_back(z);
      at = std::exchange(next[at], -1);
    }
    if (loop.size() > 2 && loop.front() == loop.back()) loop.pop_back();
    if (std::abs(signed_area(loop)) > std::abs(signed_area(longest))) longest = std::move(loop);
  }
  return longest;
}

Points rectangle(const Image& image, double margin) {
  const double right = image.width + margin, top = image.height + margin;
  return {{-margin, -margin}, {right, -margin}, {right, top}, {-margin, top}};
}

}  // namespace

std::vector<std::uint8_t> largest_part(const Image& image) {
  Grid<std::uint8_t> mask = content_of(image);
  keep_largest_part(mask);
  const bool any = std::find(mask.cells.begin(), mask.cells.end(), 1) != mask.cells.end();
  return any ? std::move(mask.cells) : std::vector<std::uint8_t>{};
}

namespace {

/// Level curves of the distance to the content. The cage follows the outer curve (`outline`) and
/// encloses the inner curve (`kept`). Both are empty if the picture has no content or no
/// transparency.
struct Levels {
  Points outline, kept;
};

Levels levels_of(const Image& image, double margin) {
  if (!has_transparency(image)) return {};
  const std::vector<std::uint8_t> part = largest_part(image);
  if (part.empty()) return {};
  // A cell covers scale x scale pixels. It is set if any of these pixels belongs to the part.
  constexpr int kMostCells = 768;
  const int longest = std::max(image.width, image.height);
  const int scale = (longest + kMostCells - 1) / kMostCells;
  // Distances are square roots of integers. A level between these values avoids the centers of
  // cells, where a level curve could touch itself.
  constexpr double kBetween = 0.0073;
  const double level = std::max(margin / scale, 1.6) + kBetween,
               kept_level = std::max(0.45 * level, 0.75) + kBetween;
  const int border = static_cast<int>(std::ceil(level)) + 3;
  Grid<std::uint8_t> cells((image.width - 1) / scale + 1 + 2 * border,
                           (image.height - 1) / scale + 1 + 2 * border, 0);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (part[static_cast<size_t>(r) * image.width + c])
        cells(border + c / scale, border + r / scale) = 1;
  const Grid<double> field = distance_field(cells);
  Levels levels{level_curve(field, level), level_curve(field, kept_level)};
  for (Points* curve : {&levels.outline, &levels.kept})
    for (Complex& z : *curve)  // cell centers to image pixels, y up
      z = {(z.real() - border + 0.5) * scale, image.height + (z.imag() + border - 0.5) * scale};
  return levels;
}

/// The cage rounded to 1/16 px, which keeps numbers in files short. Rounding cannot move the cage
/// into the content, which is at least 0.7 cells away.
Cage rounded(Cage cage) {
  for (Points& segment : cage.segments)
    for (Complex& z : segment) z = {std::round(z.real() * 16) / 16, std::round(z.imag() * 16) / 16};
  return cage;
}

}  // namespace

Cage auto_cage(const Image& image, const AutoCageOptions& options) {
  if (options.vertices < 3 || options.vertices > 500)
    throw Error(ErrorKind::bad_input,
                "a cage has 3 to 500 vertices, not " + std::to_string(options.vertices));
  const int longest = std::max(image.width, image.height);
  if (!std::isfinite(options.margin) || options.margin > 4.0 * longest)
    throw Error(ErrorKind::bad_input,
                "the margin must be at most four times the longer side of the picture");
  const double margin = options.margin < 0 ? std::max(3.0, 0.02 * longest) : options.margin;
  const Levels levels = levels_of(image, margin);
  if (levels.outline.empty()) return polygon_cage(rectangle(image, margin));
  const Cage cage =
      options.curved
          ? curves_around(levels.outline, levels.kept, options.vertices)
          : polygon_cage(simplified_around(levels.outline, levels.kept, options.vertices));
  Cage round = rounded(cage);
  return rest_fault(round) ? cage : round;
}

}  // namespace holomorph
