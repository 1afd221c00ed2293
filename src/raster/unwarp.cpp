// Draws the map's linear pieces with their rest and posed positions exchanged.
#include "raster/unwarp.h"

#include <utility>

#include "core/error.h"
#include "scene/timed_map.h"

namespace holomorph {

Image unwarped(const Scene& scene, const Image* picture, double scale, std::optional<double> time,
               const RowProgress& progress) {
  if (!picture)
    throw Error(ErrorKind::bad_input, "there is nothing to unwarp: the scene has no picture");
  check_map_size(scale, picture->page());
  TimedMap timed(scene);
  FineMap fine =
      timed.fine(timed.frame(time), kStAccuracy / scale, [&] { progress(0, picture->height); });
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
