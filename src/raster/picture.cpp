// The exported pixels use the mesh and the precision of the screen, so both show the same picture.
#include "raster/picture.h"

#include "core/error.h"
#include "scene/live_map.h"

namespace holomorph {

RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options) {
  RasterJob job;
  job.source = source;
  job.view = options.view;
  job.pixels_per_unit = options.scale;
  job.crop = options.crop;
  if (!scene.has_cage()) {
    if (options.view != View::image)
      throw Error(ErrorKind::bad_input, "this view needs a cage, and the scene has none yet");
    return rasterized(job);
  }
  if (!source && options.view == View::image)
    throw Error(ErrorKind::bad_input,
                "the scene has no picture; choose the view checker, angle, area or stretch");
  const auto prepared = prepared_map(scene, Precision::single, MeshOptions{});
  SampledMap map;
  prepared->deformer->deform(pose_of(scene), map, {is_heat(options.view)});
  if (is_heat(options.view)) {
    job.heat = heat_values(options.view, distortion_of(map));
    job.scale = heat_scale(options.view, job.heat, options.automatic_range);
  }
  job.mesh = prepared->mesh.get();
  job.positions = {map.f.data(), static_cast<size_t>(map.f.size())};
  return rasterized(job);
}

}  // namespace holomorph
