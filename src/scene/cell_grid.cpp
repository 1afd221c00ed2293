// Distances are computed column by column, then row by row. Level curves are traced by marching
// squares.
#include "scene/cell_grid.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

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

}  // namespace

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

double value_at(const Grid<float>& field, Complex z) {
  const double x = z.real(), y = -z.imag();
  const int c = static_cast<int>(x), r = static_cast<int>(y);
  const double u = x - c, v = y - r;
  return (1 - v) * ((1 - u) * field(c, r) + u * field(c + 1, r)) +
         v * ((1 - u) * field(c, r + 1) + u * field(c + 1, r + 1));
}

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

}  // namespace holomorph
