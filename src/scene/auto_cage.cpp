// The offset outline is a level curve of the content's distance field, traced by marching squares.
// simplified_around() then simplifies the outline. The result still encloses a lower level curve,
// which in turn encloses the content.
#include "scene/auto_cage.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/geometry/curve_around.h"
#include "core/geometry/polyline.h"
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

/// The number of cells of each connected set, at the index of its root.
std::vector<size_t> sizes_of(std::vector<Run>& runs) {
  std::vector<size_t> sizes(runs.size(), 0);
  for (size_t i = 0; i < runs.size(); ++i)
    sizes[root_of(runs, i)] += static_cast<size_t>(runs[i].end - runs[i].begin);
  return sizes;
}

/// Clears all ones outside the largest 8-connected set.
void keep_largest_part(Grid<std::uint8_t>& mask) {
  std::vector<Run> runs = joined_runs_of(mask);
  const std::vector<size_t> sizes = sizes_of(runs);
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
Grid<float> distance_field(const Grid<std::uint8_t>& mask) {
  Grid<float> field(mask.width, mask.height, 1e20f);
  const int longest = std::max(mask.width, mask.height);
  std::vector<double> f, d, bound(longest + 2);
  std::vector<int> site(longest + 1);
  for (int c = 0; c < mask.width; ++c) {
    f.assign(mask.height, 1e20), d.assign(mask.height, 0);
    for (int r = 0; r < mask.height; ++r) f[r] = mask(c, r) ? 0 : 1e20;
    transform_line(f, d, site, bound);
    for (int r = 0; r < mask.height; ++r) field(c, r) = static_cast<float>(d[r]);
  }
  for (int r = 0; r < mask.height; ++r) {
    f.assign(mask.width, 0), d.assign(mask.width, 0);
    for (int c = 0; c < mask.width; ++c) f[c] = field(c, r);
    transform_line(f, d, site, bound);
    for (int c = 0; c < mask.width; ++c) field(c, r) = static_cast<float>(std::sqrt(d[c]));
  }
  return field;
}

/// The outermost level curve {field = level}, as a closed polygon. Lower values lie to its left.
/// The center of cell (c, r) is at c - i r, and r increases downwards.
Points level_curve(const Grid<float>& field, double level) {
  const auto inside = [&](int c, int r) { return field(c, r) < level; };
  /// A square between four centers of cells, and the side through which the curve enters it. Sides
  /// and corners are counted counter-clockwise, from the lower side and the lower left corner.
  struct Step {
    int c, r, side;
    bool operator==(const Step&) const = default;
  };
  const auto after = [&](Step at) {
    const bool corner[4] = {inside(at.c, at.r + 1), inside(at.c + 1, at.r + 1),
                            inside(at.c + 1, at.r), inside(at.c, at.r)};
    const auto is_exit = [&](int side) { return !corner[side] && corner[(side + 1) % 4]; };
    // At a saddle, the two inside corners are connected. Therefore the curve leaves by the exit
    // that precedes the entry.
    int side = (at.side + 3) % 4;
    while (!is_exit(side)) side = (side + 3) % 4;
    constexpr int kRight[] = {0, 1, 0, -1}, kDown[] = {1, 0, -1, 0};
    return Step{at.c + kRight[side], at.r + kDown[side], (side + 2) % 4};
  };
  const auto place = [&](const Step& at) {
    const bool upright = at.side % 2 == 1;  // a side between two rows
    const int c = at.c + (at.side == 1), r = at.r + (at.side == 0);
    const double a = field(c, r), b = upright ? field(c, r + 1) : field(c + 1, r);
    const double t = std::clamp((level - a) / (b - a), 0.0, 1.0);
    return upright ? Complex(c, -(r + t)) : Complex(c + t, -r);
  };
  for (int r = 1; r < field.height; ++r)
    for (int c = 1; c < field.width; ++c) {
      if (!inside(c, r)) continue;
      const Step start{c - 1, r - 1, 1};
      Points loop;
      for (Step at = start; loop.empty() || at != start; at = after(at))
        if (const Complex z = place(at); loop.empty() || z != loop.back()) loop.push_back(z);
      if (loop.size() > 2 && loop.front() == loop.back()) loop.pop_back();
      return loop;
    }
  return {};
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

std::vector<Box> smaller_parts(const Image& image) {
  if (!has_transparency(image)) return {};
  std::vector<Run> runs = joined_runs_of(content_of(image));
  const std::vector<size_t> sizes = sizes_of(runs);
  if (runs.empty()) return {};
  const size_t largest =
      static_cast<size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::map<size_t, Box> boxes;
  for (size_t i = 0; i < runs.size(); ++i) {
    const size_t root = root_of(runs, i);
    if (root == largest || 1000 * sizes[root] < sizes[largest]) continue;
    const double top = image.height - runs[i].row;
    boxes[root].include(Complex(runs[i].begin, top - 1));
    boxes[root].include(Complex(runs[i].end, top));
  }
  std::vector<std::pair<size_t, Box>> by_size;
  for (const auto& [root, box] : boxes) by_size.emplace_back(sizes[root], box);
  std::ranges::stable_sort(by_size, std::greater<>{}, &std::pair<size_t, Box>::first);
  std::vector<Box> parts;
  for (const auto& [size, box] : by_size) parts.push_back(box);
  return parts;
}

namespace {

/// The value of a field between the centers of its cells.
double value_at(const Grid<float>& field, Complex z) {
  const double x = z.real(), y = -z.imag();
  const int c = static_cast<int>(x), r = static_cast<int>(y);
  const double u = x - c, v = y - r;
  return (1 - v) * ((1 - u) * field(c, r) + u * field(c + 1, r)) +
         v * ((1 - u) * field(c, r + 1) + u * field(c + 1, r + 1));
}

/// The part of the content around which the cage is made, on a grid of cells. A cell covers scale x
/// scale pixels. Lengths are in cells; distances are those between the centers of cells.
struct Part {
  Grid<float> distance;       ///< to the part
  int scale, border, height;  ///< border: empty cells at each side; height: of the picture, pixels
  double size;                ///< diagonal of the part's box

  /// From cells to the picture's plane, y up.
  Complex in_picture(Complex z) const {
    return {(z.real() - border + 0.5) * scale, height + (z.imag() + border - 0.5) * scale};
  }
};

/// None if the picture has no content or no transparency. Around the part, there is room for
/// distances up to `reach` pixels and up to `share` of the part's size.
std::optional<Part> part_of(const Image& image, double share, double reach) {
  if (!has_transparency(image)) return {};
  const std::vector<std::uint8_t> part = largest_part(image);
  if (part.empty()) return {};
  const auto is_set = [&](int c, int r) {
    return part[static_cast<size_t>(r) * static_cast<size_t>(image.width) + static_cast<size_t>(c)];
  };
  Box box;
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (is_set(c, r)) box.include(Complex(c, r));
  constexpr int kMostCells = 4096;
  const int longest = std::max(image.width, image.height);
  const int scale = (longest + kMostCells - 1) / kMostCells;
  const double size = (box.diagonal() + 1) / scale;
  const int border = static_cast<int>(std::ceil(std::max(share * size, reach / scale))) + 5;
  Grid<std::uint8_t> cells((image.width - 1) / scale + 1 + 2 * border,
                           (image.height - 1) / scale + 1 + 2 * border, 0);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (is_set(c, r)) cells(border + c / scale, border + r / scale) = 1;
  return Part{distance_field(cells), scale, border, image.height, size};
}

// Distances between the centers of cells. Level curves cut off corners, so that whole cells are
// enclosed only from 1 on; the rest is for rounding. Two cells are just enough for gaps of three.
constexpr double kEdge = 0.5, kEnclosing = 1.1, kLeastOuter = 1.9;

/// The point of the part's edge that is nearest to each cell, or -1 where it is farther away than
/// `reach`. The points spread to neighboring cells in sweeps over the grid.
Grid<int> nearest_points(const Part& part, const Points& edge, double reach) {
  const int width = part.distance.width, height = part.distance.height;
  Grid<int> nearest(width, height, -1);
  const auto offer = [&](int point, int c, int r) {
    if (point < 0 || part.distance(c, r) > reach) return;
    const Complex z(c, -r);
    int& best = nearest(c, r);
    if (best < 0 || std::norm(edge[static_cast<size_t>(point)] - z) <
                        std::norm(edge[static_cast<size_t>(best)] - z))
      best = point;
  };
  for (size_t i = 0; i < edge.size(); ++i)
    offer(static_cast<int>(i), static_cast<int>(std::round(edge[i].real())),
          static_cast<int>(std::round(-edge[i].imag())));
  for (int sweep = 0; sweep < 4; ++sweep) {
    const bool down = sweep % 2 == 0;
    const int step = down ? 1 : -1;
    for (int row = 1; row + 1 < height; ++row) {
      const int r = down ? row : height - 1 - row;
      for (int c = 1; c + 1 < width; ++c)
        for (const int right : {-1, 0, 1}) offer(nearest(c + right, r - step), c, r);
      for (int c = 1; c < width; ++c) offer(nearest(c - 1, r), c, r);
      for (int c = width - 2; c >= 0; --c) offer(nearest(c + 1, r), c, r);
    }
  }
  return nearest;
}

/// The distance to the middle of narrow gaps between limbs, and of the regions in front of them.
/// There, the nearest points of the part's edge are farther apart along the edge than a tenth of
/// the size for two neighboring cells. None if there are no gaps up to this distance from the part.
std::optional<Grid<float>> distance_to_gaps(const Part& part, double reach) {
  const Points edge = level_curve(part.distance, kEdge);
  std::vector<double> along{0};
  for (size_t i = 0; i < edge.size(); ++i)
    along.push_back(along.back() + std::abs(edge[(i + 1) % edge.size()] - edge[i]));
  const Grid<int> nearest = nearest_points(part, edge, reach);
  const auto belongs_to_two = [&](int a, int b) {
    if (a < 0 || b < 0) return false;
    const double between = std::abs(along[static_cast<size_t>(a)] - along[static_cast<size_t>(b)]);
    return std::min(between, along.back() - between) > 0.1 * part.size;
  };
  Grid<std::uint8_t> middles(part.distance.width, part.distance.height, 0);
  bool any = false;
  for (int r = 0; r + 1 < middles.height; ++r)
    for (int c = 1; c + 1 < middles.width; ++c)
      for (const auto& [right, down] : {std::pair(1, 0), {-1, 1}, {0, 1}, {1, 1}}) {
        if (!belongs_to_two(nearest(c, r), nearest(c + right, r + down))) continue;
        const float here = part.distance(c, r), there = part.distance(c + right, r + down);
        if (here >= there) middles(c, r) = 1;
        if (there >= here) middles(c + right, r + down) = 1;
        any = true;
      }
  if (!any) return {};
  return distance_field(middles);
}

/// Where the cage may run: between two distances from the part and, so that limbs remain apart, not
/// across the middle of a gap.
class Band {
 public:
  /// `to_gaps` may be null.
  Band(const Part& part, const Grid<float>* to_gaps, double margin)
      : part_(part),
        to_gaps_(to_gaps),
        outer_(std::max(kEdge + 2 * margin, kLeastOuter)),
        middle_(kEnclosing + 0.6 * (outer_ - kEnclosing)) {}

  /// Makes the band narrower, which leaves more vertices to a polygon in it.
  void narrow() { outer_ = middle_ + 0.25 * (outer_ - middle_); }

  /// The curve on which the cage's vertices lie.
  Points middle() const {
    constexpr double kMiddle = 0.7;  // of the way to the middle of a gap
    if (!to_gaps_) return level_curve(part_.distance, middle_);
    Grid<float> field = part_.distance;
    for (size_t i = 0; i < field.cells.size(); ++i)
      field.cells[i] = std::max(
          field.cells[i],
          static_cast<float>(middle_ / kMiddle * share(field.cells[i], to_gaps_->cells[i])));
    return level_curve(field, middle_);
  }
  /// A curve that encloses the part and lies inside the band.
  Points inner() const { return level_curve(part_.distance, kEnclosing); }

  bool contains(Complex z) const {
    constexpr double kOuter = 0.94;
    const double d = value_at(part_.distance, z);
    return d >= kEnclosing && d <= outer_ &&
           (!to_gaps_ || share(d, value_at(*to_gaps_, z)) <= kOuter);
  }

 private:
  /// How far a point is on the way from the part to the middle of a gap. Gaps of one or two cells
  /// are ignored, because they have no room for two edges of the cage.
  static double share(double d, double to_gap) { return d > kTurning ? d / (d + to_gap) : 0; }
  static constexpr double kTurning = 1.05;

  const Part& part_;
  const Grid<float>* to_gaps_;
  double outer_, middle_;
};

/// A polygon in the band with edges as long as possible.
Points polygon_in(const Band& band) {
  const Points curve = band.middle();
  const size_t n = curve.size();
  const auto is_free = [&](size_t i, size_t j) {
    const Complex a = curve[i % n], b = curve[j % n];
    const int steps = static_cast<int>(2 * std::abs(b - a)) + 1;
    for (int k = 1; k < steps; ++k)
      if (!band.contains(a + (b - a) * (static_cast<double>(k) / steps))) return false;
    return true;
  };
  // The farthest point up to `end` that an edge from i can reach.
  const auto reach = [&](size_t i, size_t end) {
    const size_t most = std::min(end - i, n / 3 + 1);
    size_t step = 1;
    while (2 * step <= most && is_free(i, i + 2 * step)) step *= 2;
    for (size_t more = step; more > 0; more /= 2)
      if (step + more <= most && is_free(i, i + step + more)) step += more;
    return i + step;
  };
  // The end of a longest edge is a better start than an arbitrary point.
  size_t first = 0;
  for (size_t i = 0; i < n; i = reach(i, 2 * n)) first = i;
  Points polygon;
  for (size_t i = first; i < first + n; i = reach(i, first + n)) polygon.push_back(curve[i % n]);
  return polygon;
}

/// A simple polygon with at most `most` vertices around the part. Its margin grows if there would
/// be more vertices, and shrinks if edges would cross. If nothing else helps, limbs are joined.
Points tight_polygon(const Part& part, const Grid<float>* to_gaps, double usual_margin, int most) {
  constexpr int kTries = 10;
  const double largest_margin = std::max(0.5, (part.border - 4) / 2.0);  // the grid ends there
  double margin = usual_margin;
  for (const Grid<float>* gaps : {to_gaps, static_cast<const Grid<float>*>(nullptr)}) {
    margin = usual_margin;
    for (int tries = 0; tries < kTries; ++tries) {
      const Points polygon = polygon_in(Band(part, gaps, margin));
      const bool crosses = self_crossing(polygon).has_value(),
                 fits = static_cast<int>(polygon.size()) <= most;
      if (fits && !crosses) return polygon;
      margin = std::clamp(crosses ? 0.6 * margin : 1.4 * margin, 0.5, largest_margin);
    }
  }
  return simplified_around(Band(part, nullptr, margin).middle(),
                           Band(part, nullptr, margin).inner(), most);
}

/// A closed curve with fewer points, for fits whose cost grows with their number.
Points thinned(const Points& curve) {
  constexpr Index kMost = 4000;
  return static_cast<Index>(curve.size()) <= kMost ? curve
                                                   : at_equal_lengths(Polyline(curve, true), kMost);
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
  constexpr int kMostVertices = 500;
  if (options.vertices && (*options.vertices < 3 || *options.vertices > kMostVertices))
    throw Error(ErrorKind::bad_input,
                "a cage has 3 to 500 vertices, not " + std::to_string(*options.vertices));
  if (!(options.detail >= 0 && options.detail <= 100))
    throw Error(ErrorKind::bad_input, "the detail must be between 0 and 100");
  const int longest = std::max(image.width, image.height);
  if (options.margin && !(std::abs(*options.margin) <= 4.0 * longest))
    throw Error(ErrorKind::bad_input,
                "the margin must be at most four times the longer side of the picture");
  // Half a percent of the size at medium detail, a quarter of that or four times as much at the
  // ends of the slider.
  const double usual = 0.005 * std::pow(4, 1 - options.detail / 50);
  const auto part = part_of(image, 4 * usual, 2 * options.margin.value_or(1));
  if (!part) return polygon_cage(rectangle(image, std::max(0.0, options.margin.value_or(0))));
  // Curves need more room than polygons.
  const double tight = (options.curved ? 3 : 1) * usual * part->size,
               margin = std::max(0.5, options.margin ? *options.margin / part->scale : tight);
  const std::optional<Grid<float>> gaps =
      options.margin || options.curved ? std::nullopt : distance_to_gaps(*part, 3 * margin + 4);
  const Grid<float>* to_gaps = gaps ? &*gaps : nullptr;
  const auto in_picture = [&](Points points) {
    for (Complex& z : points) z = part->in_picture(z);
    return points;
  };
  Band band(*part, to_gaps, margin);
  const int usual_vertices = static_cast<int>(std::lround(30 * std::exp2(options.detail / 50 - 1))),
            vertices = options.vertices.value_or(usual_vertices);
  Cage cage;
  if (options.curved) {
    const double kept = std::max(kEnclosing, kEdge + 0.45 * margin),
                 outer = std::max(kept + 0.5, kEdge + margin);
    cage = curves_around(thinned(in_picture(level_curve(part->distance, outer))),
                         thinned(in_picture(level_curve(part->distance, kept))), vertices);
  } else if (options.vertices) {
    band.narrow();
    const Points polygon = polygon_in(band);
    cage =
        polygon_cage(simplified_around(in_picture(self_crossing(polygon) ? band.middle() : polygon),
                                       in_picture(band.inner()), vertices));
  } else {
    cage = polygon_cage(in_picture(tight_polygon(*part, to_gaps, margin, kMostVertices)));
  }
  Cage round = rounded(cage);
  return rest_fault(round) ? cage : round;
}

}  // namespace holomorph
