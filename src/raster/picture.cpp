// The exported pixels use the mesh and the precision of the screen, so both show the same picture.
#include "raster/picture.h"

#include "core/distortion.h"
#include "core/error.h"

namespace holomorph {

RasterResult picture_of(const Scene& scene, const Image* source, const PictureOptions& options) {
  return PictureMaker(scene, source).picture(options);
}

PictureMaker::PictureMaker(const Scene& scene, const Image* source)
    : scene_(scene), source_(source) {
  if (scene.has_cage()) prepared_ = prepared_map(scene, Precision::single, MeshOptions{});
}

PictureMaker::~PictureMaker() = default;

SampledMap PictureMaker::map_at(const std::optional<double>& time, bool derivatives) {
  SampledMap map;
  if (!time || scene_.keyframes.empty()) {
    prepared_->deformer->deform(pose_of(scene_), map, {derivatives});
    return map;
  }
  motion_.follow(scene_, prepared_);
  if (motion_.error()) throw Error(*motion_.error());
  if (!motion_.plays())
    throw Error(ErrorKind::bad_input,
                "none of the keyframes has the scene's cage points, pins and strokes");
  map.f = motion_.map_at(*time);
  if (!derivatives) return map;
  VertexDerivatives at = vertex_derivatives(*prepared_->mesh, map.f);
  map.fz = std::move(at.fz);
  map.fzbar = std::move(at.fzbar);
  return map;
}

RasterResult PictureMaker::picture(const PictureOptions& options) {
  RasterJob job;
  job.source = source_;
  job.view = options.view;
  job.pixels_per_unit = options.scale;
  job.crop = options.crop;
  job.shows = options.shows;
  if (!scene_.has_cage()) {
    if (options.view != View::image)
      throw Error(ErrorKind::bad_input, "this view needs a cage, and the scene has none yet");
    return rasterized(job);
  }
  if (!source_ && options.view == View::image)
    throw Error(ErrorKind::bad_input,
                "the scene has no picture; choose the view checker, angle, area or stretch");
  const SampledMap map = map_at(options.time, is_heat(options.view));
  if (is_heat(options.view)) {
    job.heat = heat_values(options.view, distortion_of(map));
    job.scale = heat_scale(options.view, job.heat, options.automatic_range);
  }
  job.mesh = prepared_->mesh.get();
  job.positions = {map.f.data(), static_cast<size_t>(map.f.size())};
  return rasterized(job);
}

std::optional<Box> PictureMaker::shown_at(std::span<const double> times,
                                          const std::function<bool()>& go_on) {
  Box box;
  if (source_) {
    box.include(0);
    box.include({static_cast<double>(source_->width), static_cast<double>(source_->height)});
  }
  if (!scene_.has_cage()) return box;
  for (const double time : times) {
    if (!go_on()) return {};
    for (const Complex& z : map_at(time, false).f) box.include(z);
  }
  // Operators in single precision are no reason for another row of pixels.
  constexpr double kRounding = 1e-3;
  return Box{box.left + kRounding, box.bottom + kRounding, box.right - kRounding,
             box.top - kRounding};
}

}  // namespace holomorph
