// Draws the map's linear pieces with positions in place of colors.
#include "raster/st_map.h"

#include <cstring>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "raster/nearest_covered.h"
#include "raster/scan.h"

namespace holomorph {
namespace {

constexpr int kBandRows = 16;  ///< rows that one task draws
constexpr int kSamples = 4;    ///< samples of the coverage per pixel and direction

/// Triangles whose corners lie at positions of the ST-map, in pixels with y down, and have values.
/// Without values, they erase what they cover.
struct DrawnMesh {
  const std::vector<Triangle>& triangles;
  Points at;
  std::vector<std::array<double, 2>> values;
};

/// The triangles that touch each band of rows.
std::vector<std::vector<int>> banded(const DrawnMesh& mesh, int height) {
  std::vector<std::vector<int>> bands(static_cast<size_t>((height + kBandRows - 1) / kBandRows));
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    double low = 1e300, high = -1e300;
    bool is_finite = true;
    for (const int v : mesh.triangles[t]) {
      const size_t corner = static_cast<size_t>(v);
      is_finite = is_finite && holomorph::is_finite(mesh.at[corner]);
      if (!mesh.values.empty())
        for (const double value : mesh.values[corner])
          is_finite = is_finite && std::isfinite(value);
      low = std::min(low, mesh.at[static_cast<size_t>(v)].imag());
      high = std::max(high, mesh.at[static_cast<size_t>(v)].imag());
    }
    const double last_band = static_cast<double>(bands.size()) - 1;
    if (!is_finite || high < 0 || low > height) continue;
    for (int band = static_cast<int>(std::max(0.0, std::floor(low / kBandRows)));
         band <= static_cast<int>(std::min(last_band, std::floor(high / kBandRows))); ++band)
      bands[static_cast<size_t>(band)].push_back(static_cast<int>(t));
  }
  return bands;
}

/// A triangle of a DrawnMesh, with a position in the other picture for each point.
class DrawnTriangle {
 public:
  DrawnTriangle(const DrawnMesh& mesh, const Triangle& t) : erases_(mesh.values.empty()) {
    for (size_t k = 0; k < 3; ++k) {
      x_[k] = mesh.at[static_cast<size_t>(t[k])].real();
      y_[k] = mesh.at[static_cast<size_t>(t[k])].imag();
    }
    const double ax = x_[1] - x_[0], ay = y_[1] - y_[0], bx = x_[2] - x_[0], by = y_[2] - y_[0];
    area_ = ax * by - ay * bx;
    if (erases_ || !draws()) return;
    for (size_t k = 0; k < 2; ++k) {
      const auto value = [&](size_t corner) {
        return mesh.values[static_cast<size_t>(t[corner])][k];
      };
      const double a = value(0), p = value(1) - a, q = value(2) - a;
      const auto [least, most] = std::minmax({a, value(1), value(2)});
      parts_[k] = {a, (p * by - q * ay) / area_, (q * ax - p * bx) / area_, least, most};
    }
  }

  bool draws() const { return std::abs(area_) > 1e-12; }
  bool erases() const { return erases_; }
  /// Whether all points have a position in the other picture's rectangle.
  bool is_inside() const {
    return std::ranges::all_of(parts_,
                               [](const Part& part) { return part.least >= 0 && part.most <= 1; });
  }
  /// The positions s (k = 0) and t (k = 1) at a point of the ST-map.
  double value(size_t k, double x, double y) const {
    const Part& part = parts_[k];
    // In a sliver, rounding must not lead beyond the corners' values.
    return std::clamp(part.at_first + part.across * (x - x_[0]) + part.down * (y - y_[0]),
                      part.least, part.most);
  }

  /// Calls `row(r, begin, end)` for each row of samples from `first` to before `last`, with the
  /// half-open range of samples whose centers the triangle covers. There are `samples` per pixel
  /// and direction, and `columns` in a row.
  template <class Row>
  void scan(int samples, int first, int last, int columns, const Row& row) const {
    double x[3], y[3];
    for (size_t k = 0; k < 3; ++k) x[k] = samples * x_[k], y[k] = samples * y_[k];
    const auto [low, high] = std::minmax({y[0], y[1], y[2]});
    const int begin = std::max(first, static_cast<int>(std::clamp(low, 0.0, 1e9))),
              end = std::min(last, static_cast<int>(std::clamp(high, -1.0, 1e9)) + 1);
    for (int r = begin; r < end; ++r) {
      double left = 0, right = 0;
      if (!span_at(x, y, r + 0.5, left, right)) continue;
      const int from = first_center(std::clamp(left, 0.0, static_cast<double>(columns))),
                to = first_center(std::clamp(right, 0.0, static_cast<double>(columns)));
      if (from < to) row(r, from, to);
    }
  }

 private:
  struct Part {
    double at_first = 0, across = 0, down = 0, least = 0, most = 0;
  };

  bool erases_;
  double x_[3], y_[3], area_ = 0;
  std::array<Part, 2> parts_;
};

/// Draws meshes into an ST-map, later ones on top.
class StMapDrawing {
 public:
  /// Where meshes overlap, `picture` decides by its opacity which one is shown; if null, it is the
  /// last one.
  StMapDrawing(StMap& map, std::vector<DrawnMesh> meshes, const Image* picture)
      : map_(map), meshes_(std::move(meshes)), picture_(picture) {
    for (const DrawnMesh& mesh : meshes_) bands_.push_back(banded(mesh, map.height));
    map_.st.resize(2 * pixels());
    map_.coverage.resize(pixels());
  }

  void draw(const RowProgress& progress) {
    parallel_for(
        (map_.height + kBandRows - 1) / kBandRows, [&](int band) { draw_band(band); },
        [&](int started) { progress(std::min(started * kBandRows, map_.height), map_.height); });
  }

 private:
  size_t pixels() const {
    return static_cast<size_t>(map_.width) * static_cast<size_t>(map_.height);
  }

  template <class Draw>
  void for_triangles(int band, const Draw& draw) const {
    for (size_t m = 0; m < meshes_.size(); ++m)
      for (const int t : bands_[m][static_cast<size_t>(band)]) {
        const DrawnTriangle triangle(meshes_[m], meshes_[m].triangles[static_cast<size_t>(t)]);
        if (triangle.draws()) draw(triangle);
      }
  }

  void draw_band(int band) {
    const int first = band * kBandRows, end = std::min(map_.height, first + kBandRows);
    draw_positions(band, first, end);
    draw_coverage(band, first, end);
  }

  void draw_positions(int band, int first, int end) {
    const auto at = [&](int row, int column) {
      return &map_.st[2 * (static_cast<size_t>(row) * static_cast<size_t>(map_.width) +
                           static_cast<size_t>(column))];
    };
    for (int r = first; r < end; ++r)  // points outside the cage do not move
      for (int c = 0; c < map_.width; ++c) {
        at(r, c)[0] = static_cast<float>((c + 0.5 - map_.overscan) / shown(map_.width));
        at(r, c)[1] = static_cast<float>(1 - (r + 0.5 - map_.overscan) / shown(map_.height));
      }
    for_triangles(band, [&](const DrawnTriangle& triangle) {
      triangle.scan(1, first, end, map_.width, [&](int r, int from, int to) {
        if (triangle.erases())
          return std::fill(at(r, from), at(r, from) + 2 * (to - from),
                           std::numeric_limits<float>::quiet_NaN());
        for (int c = from; c < to; ++c) {
          const std::array above{static_cast<float>(triangle.value(0, c + 0.5, r + 0.5)),
                                 static_cast<float>(triangle.value(1, c + 0.5, r + 0.5))};
          if (!picture_ || !shows_through(above.data(), at(r, c)))
            std::ranges::copy(above, at(r, c));
        }
      });
    });
  }

  void draw_coverage(int band, int first, int end) {
    const int columns = kSamples * map_.width, top = kSamples * first, bottom = kSamples * end,
              over = kSamples * map_.overscan;
    std::vector<std::uint8_t> shows(static_cast<size_t>(columns) *
                                    static_cast<size_t>(bottom - top));
    const auto at = [&](int row, int column) {
      return &shows[static_cast<size_t>(row - top) * static_cast<size_t>(columns) +
                    static_cast<size_t>(column)];
    };
    for (int r = std::max(top, over); r < std::min(bottom, kSamples * map_.height - over); ++r)
      std::memset(at(r, over), 1, static_cast<size_t>(columns - 2 * over));
    for_triangles(band, [&](const DrawnTriangle& triangle) {
      const bool is_same = triangle.erases() || triangle.is_inside();
      triangle.scan(kSamples, top, bottom, columns, [&](int r, int from, int to) {
        if (is_same)
          std::memset(at(r, from), triangle.erases() ? 0 : 1, static_cast<size_t>(to - from));
        else
          for (int c = from; c < to; ++c) *at(r, c) |= is_sample_inside(triangle, r, c);
      });
    });
    constexpr float kShare = 1.0f / (kSamples * kSamples);
    for (int r = first; r < end; ++r)
      for (int c = 0; c < map_.width; ++c) {
        int count = 0;
        for (int k = 0; k < kSamples; ++k) {
          const std::uint8_t* row = at(kSamples * r + k, kSamples * c);
          count = std::accumulate(row, row + kSamples, count);
        }
        map_.coverage[static_cast<size_t>(r) * static_cast<size_t>(map_.width) +
                      static_cast<size_t>(c)] = kShare * static_cast<float>(count);
      }
  }

  static bool is_sample_inside(const DrawnTriangle& triangle, int row, int column) {
    for (size_t k = 0; k < 2; ++k) {
      const double value = triangle.value(k, (column + 0.5) / kSamples, (row + 0.5) / kSamples);
      if (!(value >= 0 && value <= 1)) return false;
    }
    return true;
  }

  /// The opacity of the picture at a position, from 0 to 255.
  int opacity_at(const float* st) const {
    const Box page = picture_->page();
    const double x = std::floor(static_cast<double>(st[0]) * page.width()) -
                     (picture_->left - page.left),
                 y = std::floor((1 - static_cast<double>(st[1])) * page.height()) -
                     (page.top - picture_->top());
    if (!(x >= 0 && x < picture_->width && y >= 0 && y < picture_->height)) return 0;
    return picture_->at(static_cast<int>(x), static_cast<int>(y))[3];
  }

  bool shows_through(const float* above, const float* below) const {
    const int opacity = opacity_at(above);
    return opacity < 128 && !std::isnan(below[0]) && opacity_at(below) > opacity;
  }

  double shown(int side) const { return side - 2 * map_.overscan; }

  StMap& map_;
  std::vector<DrawnMesh> meshes_;
  const Image* picture_;
  std::vector<std::vector<std::vector<int>>> bands_;
};

}  // namespace

void check_map_size(double scale, const Box& page, int overscan) {
  constexpr double kMost = 16384;
  if (page.width() <= 0 || page.height() <= 0)
    throw Error(ErrorKind::bad_input, "the scene has no picture to map");
  if (!(scale > 0) || overscan < 0 ||
      !(std::max(page.width(), page.height()) * scale + 2.0 * overscan <= kMost))
    throw Error(ErrorKind::bad_input,
                "the scale must be above 0, and the result at most 16384 pixels on a side, "
                "including the overscan");
}

StMap st_map_of(TimedMap& map, const Image& picture, const StMapOptions& options,
                const RowProgress& progress) {
  const Box page = picture.page();
  check_map_size(options.scale, page, options.overscan);
  const auto side = [&](double pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels * options.scale))) +
           2 * options.overscan;
  };
  StMap result{side(page.width()), side(page.height()), options.overscan, {}, {}};
  const double width = page.width(), height = page.height(),
               across = (result.width - 2 * options.overscan) / width,
               down = (result.height - 2 * options.overscan) / height;
  const FineMap fine = map.fine(map.frame(options.time), kStAccuracy / std::max(across, down),
                                [&] { progress(0, result.height); });
  const auto placed = [&](std::span<const Complex> points) {
    Points at;
    for (const Complex& z : points)
      at.emplace_back((z.real() - page.left) * across + options.overscan,
                      (page.top - z.imag()) * down + options.overscan);
    return at;
  };
  const Points& rest = fine.mesh.vertices;
  DrawnMesh drawn{fine.mesh.triangles, placed(options.unwarps ? rest : fine.f), {}};
  for (const Complex& z : options.unwarps ? fine.f : rest)
    drawn.values.push_back({(z.real() - page.left) / width, (z.imag() - page.bottom) / height});
  // What leaves its position shows nothing. The fine mesh follows curves, but lacks the triangles
  // with images that are not finite.
  std::vector<DrawnMesh> meshes;
  meshes.push_back({map.mesh().triangles, placed(map.mesh().vertices), {}});
  meshes.push_back({fine.mesh.triangles, placed(rest), {}});
  meshes.push_back(std::move(drawn));
  StMapDrawing(result, std::move(meshes), options.unwarps ? nullptr : &picture).draw(progress);
  return result;
}

void extend(StMap& map) {
  const auto at = [&](int row, int column) {
    return &map.st[2 * (static_cast<size_t>(row) * static_cast<size_t>(map.width) +
                        static_cast<size_t>(column))];
  };
  std::vector<bool> shows(map.coverage.size());
  for (size_t i = 0; i < shows.size(); ++i)
    shows[i] = std::isfinite(map.st[2 * i]) && std::isfinite(map.st[2 * i + 1]);
  const NearestCovered nearest(map.width, map.height, shows);
  for (int r = 0; r < map.height; ++r)
    for (int c = 0; c < map.width; ++c) {
      const PixelIndex from = nearest.at(c, r);
      if (from.column < 0)
        std::fill_n(at(r, c), 2, 0.0f);  // the picture shows nothing anywhere
      else
        std::copy_n(at(from.row, from.column), 2, at(r, c));
    }
}

FloatImage float_image_of(StMap map) {
  FloatImage image{{map.width, map.height, map.overscan}, {}};
  image.pixels.reserve(4 * map.coverage.size());
  for (size_t i = 0; i < map.coverage.size(); ++i)
    image.pixels.insert(image.pixels.end(),
                        {map.st[2 * i], map.st[2 * i + 1], map.coverage[i], map.coverage[i]});
  return image;
}

}  // namespace holomorph
