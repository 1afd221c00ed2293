// Unwarping draws the mesh with its rest and posed positions exchanged.
#include "raster/unwarp.h"

#include <limits>

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/inverse.h"
#include "scene/timed_map.h"
#include "system/parallel.h"

namespace holomorph {
namespace {

/// Computes the positions of one row of pixels.
void fill_row(const Cage& rest, const InverseMap& inverse, double scale, int row, double height,
              double width, StMap& map) {
  for (int c = 0; c < map.width; ++c) {
    const Complex w((c + 0.5) / scale, height - (row + 0.5) / scale);
    const auto found = inverse.at(w);
    Complex z(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());
    if (!found.empty())
      z = found[0].z;
    else if (!contains(rest, w))
      z = w;  // points outside the cage do not move
    float* out = &map.st[2 * (static_cast<size_t>(row) * map.width + c)];
    out[0] = static_cast<float>(z.real() / width);
    out[1] = static_cast<float>(z.imag() / height);
  }
}

}  // namespace

StMap st_map_of(const Scene& scene, int picture_width, int picture_height, double scale,
                std::optional<double> time,
                const std::function<void(int done, int all)>& progress) {
  const double width = picture_width, height = picture_height;
  if (!(scale > 0) || !(std::max(width, height) * scale <= 16384))
    throw Error(ErrorKind::bad_input,
                "the scale must be positive and give at most 16384 pixels on a side");
  if (picture_width <= 0 || picture_height <= 0)
    throw Error(ErrorKind::bad_input, "an ST-map needs a picture, and the scene has none");
  TimedMap timed(scene);
  const auto inverse = timed.inverse(timed.frame(time));
  if (!inverse)
    throw Error(ErrorKind::bad_input,
                "method '" + scene.deformation().method + "' has no inverse to export");
  StMap map{std::max(1, static_cast<int>(std::lround(width * scale))),
            std::max(1, static_cast<int>(std::lround(height * scale))),
            {}};
  map.st.resize(2 * static_cast<size_t>(map.width) * map.height);
  const auto draw_row = [&](int row) {
    fill_row(scene.deformation().rest, inverse->inverse, scale, row, height, width, map);
  };
  parallel_for(map.height, draw_row, [&](int started) { progress(started, map.height); });
  return map;
}

Image unwarped(const Scene& scene, const Image* picture, double scale, std::optional<double> time) {
  if (!picture)
    throw Error(ErrorKind::bad_input, "there is nothing to unwarp: the scene has no picture");
  TimedMap timed(scene);
  const VectorXc f = timed.on_mesh(timed.frame(time)).f;
  Mesh posed = timed.mesh();
  posed.vertices.assign(f.begin(), f.end());
  RasterJob job;
  job.mesh = &posed;
  job.positions = timed.mesh().vertices;
  job.source = picture;
  job.pixels_per_unit = scale;
  job.crop = true;
  job.surroundings = false;
  return rasterized(job).image;
}

}  // namespace holomorph
