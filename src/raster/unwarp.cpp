// Both functions draw the map's linear pieces. Unwarping exchanges their rest and posed positions;
// an ST-map draws the rest positions themselves in place of colors.
#include "raster/unwarp.h"

#include <limits>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "raster/scan.h"
#include "scene/timed_map.h"

namespace holomorph {
namespace {

constexpr int kTaskRows = 16;  ///< rows that one task draws

/// Triangles whose corners have positions on the ST-map, in pixels with y down, and values.
struct DrawnMesh {
  const std::vector<Triangle>& triangles;
  Points at;
  std::vector<std::array<double, 2>> values;
};

/// The triangles that touch each band of rows.
std::vector<std::vector<int>> banded(const DrawnMesh& mesh, int height) {
  std::vector<std::vector<int>> bands(static_cast<size_t>((height + kTaskRows - 1) / kTaskRows));
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    double low = 1e300, high = -1e300;
    bool is_finite = true;
    for (const int v : mesh.triangles[t]) {
      is_finite = is_finite && holomorph::is_finite(mesh.at[static_cast<size_t>(v)]);
      low = std::min(low, mesh.at[static_cast<size_t>(v)].imag());
      high = std::max(high, mesh.at[static_cast<size_t>(v)].imag());
    }
    const double last_band = static_cast<double>(bands.size()) - 1;
    if (!is_finite || high < 0 || low > height) continue;
    for (int band = static_cast<int>(std::max(0.0, std::floor(low / kTaskRows)));
         band <= static_cast<int>(std::min(last_band, std::floor(high / kTaskRows))); ++band)
      bands[static_cast<size_t>(band)].push_back(static_cast<int>(t));
  }
  return bands;
}

/// Draws the part of a triangle that lies in some rows.
void draw(const DrawnMesh& mesh, const Triangle& t, int first_row, int end_row, StMap& map) {
  double x[3], y[3], s[3], v[3];
  for (size_t k = 0; k < 3; ++k) {
    const size_t corner = static_cast<size_t>(t[k]);
    x[k] = mesh.at[corner].real(), y[k] = mesh.at[corner].imag();
    s[k] = mesh.values[corner][0], v[k] = mesh.values[corner][1];
  }
  const double ax = x[1] - x[0], ay = y[1] - y[0], bx = x[2] - x[0], by = y[2] - y[0],
               area = ax * by - ay * bx;
  if (!(std::abs(area) > 1e-12)) return;
  const auto [low, high] = std::minmax({y[0], y[1], y[2]});
  const int begin = std::max(first_row, static_cast<int>(std::max(low, 0.0))),
            end = std::min(end_row, static_cast<int>(std::min(high, 1e9)) + 1);
  // In a sliver, rounding must not lead beyond the corners' values.
  const auto [least_s, most_s] = std::minmax({s[0], s[1], s[2]});
  const auto [least_v, most_v] = std::minmax({v[0], v[1], v[2]});
  const auto slope = [&](const double(&w)[3], double& wx, double& wy) {
    const double p = w[1] - w[0], q = w[2] - w[0];
    wx = (p * by - q * ay) / area;
    wy = (q * ax - p * bx) / area;
  };
  double sx, sy, vx, vy;
  slope(s, sx, sy);
  slope(v, vx, vy);
  for (int row = begin; row < end; ++row) {
    double left = 0, right = 0;
    if (!span_at(x, y, row + 0.5, left, right)) continue;
    left = std::max(left, 0.0);
    right = std::min(right, static_cast<double>(map.width));
    const double down = row + 0.5 - y[0];
    for (int c = first_center(left); c < first_center(right); ++c) {
      const double across = c + 0.5 - x[0];
      float* out = &map.st[2 * (static_cast<size_t>(row) * static_cast<size_t>(map.width) +
                                static_cast<size_t>(c))];
      out[0] = static_cast<float>(std::clamp(s[0] + sx * across + sy * down, least_s, most_s));
      out[1] = static_cast<float>(std::clamp(v[0] + vx * across + vy * down, least_v, most_v));
    }
  }
}

void draw_rows(std::initializer_list<const DrawnMesh*> meshes, StMap& map,
               const RowProgress& progress) {
  std::vector<std::vector<std::vector<int>>> bands;
  for (const DrawnMesh* mesh : meshes) bands.push_back(banded(*mesh, map.height));
  const auto draw_band = [&](int band) {
    const int first = band * kTaskRows, end = std::min(map.height, first + kTaskRows);
    auto of_mesh = bands.begin();
    for (const DrawnMesh* mesh : meshes)
      for (const int t : (*of_mesh++)[static_cast<size_t>(band)])
        draw(*mesh, mesh->triangles[static_cast<size_t>(t)], first, end, map);
  };
  parallel_for((map.height + kTaskRows - 1) / kTaskRows, draw_band, [&](int started) {
    progress(std::min(started * kTaskRows, map.height), map.height);
  });
}

void check_scale(double scale, int width, int height) {
  if (!(scale > 0) || !(std::max(width, height) * scale <= 16384))
    throw Error(ErrorKind::bad_input,
                "the scale must be positive and give at most 16384 pixels on a side");
}

}  // namespace

StMap st_map_of(const Scene& scene, int picture_width, int picture_height, double scale,
                std::optional<double> time, const RowProgress& progress) {
  const double width = picture_width, height = picture_height;
  check_scale(scale, picture_width, picture_height);
  if (picture_width <= 0 || picture_height <= 0)
    throw Error(ErrorKind::bad_input, "an ST-map needs a picture, and the scene has none");
  StMap map{std::max(1, static_cast<int>(std::lround(width * scale))),
            std::max(1, static_cast<int>(std::lround(height * scale))),
            {}};
  TimedMap timed(scene);
  const FineMap fine =
      timed.fine(timed.frame(time), kUnwarpAccuracy / scale, [&] { progress(0, map.height); });
  map.st.resize(2 * static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
  for (int row = 0; row < map.height; ++row)  // points outside the cage do not move
    for (int c = 0; c < map.width; ++c) {
      float* out = &map.st[2 * (static_cast<size_t>(row) * static_cast<size_t>(map.width) +
                                static_cast<size_t>(c))];
      out[0] = static_cast<float>((c + 0.5) / scale / width);
      out[1] = static_cast<float>(1 - (row + 0.5) / scale / height);
    }
  const auto drawn = [&](const Mesh& mesh, const Points& at) {
    DrawnMesh drawn{mesh.triangles, {}, {}};
    for (const Complex& z : at)
      drawn.at.emplace_back(z.real() * scale, (height - z.imag()) * scale);
    return drawn;
  };
  // What leaves its position shows nothing. The fine mesh follows curves, but lacks the triangles
  // with images that are not finite.
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  DrawnMesh coarse = drawn(timed.mesh(), timed.mesh().vertices),
            left = drawn(fine.mesh, fine.mesh.vertices), posed = drawn(fine.mesh, fine.f);
  coarse.values.assign(coarse.at.size(), {kNan, kNan});
  left.values.assign(left.at.size(), {kNan, kNan});
  for (const Complex& z : fine.mesh.vertices)
    posed.values.push_back({z.real() / width, z.imag() / height});
  draw_rows({&coarse, &left, &posed}, map, progress);
  return map;
}

Image unwarped(const Scene& scene, const Image* picture, double scale, std::optional<double> time,
               const RowProgress& progress) {
  if (!picture)
    throw Error(ErrorKind::bad_input, "there is nothing to unwarp: the scene has no picture");
  check_scale(scale, picture->width, picture->height);
  TimedMap timed(scene);
  FineMap fine =
      timed.fine(timed.frame(time), kUnwarpAccuracy / scale, [&] { progress(0, picture->height); });
  const Points rest = std::exchange(fine.mesh.vertices, std::move(fine.f));
  RasterJob job;
  job.mesh = &fine.mesh;
  job.positions = rest;
  job.source = picture;
  job.pixels_per_unit = scale;
  job.crop = true;
  job.surroundings = false;
  return rasterized(job).image;
}

}  // namespace holomorph
