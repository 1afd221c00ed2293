// The picture is the texture: no pixel is sampled twice.
#include "raster/textured.h"

#include <algorithm>

#include "core/error.h"
#include "raster/bleed.h"
#include "raster/raster.h"
#include "scene/file.h"
#include "scene/live_map.h"

namespace holomorph {

namespace {

/// Which pixels of a picture the posed map covers wholly: a checker is opaque there.
std::vector<bool> covered(RasterJob job, const RasterResult& picture) {
  job.view = View::checker;
  const auto [checker, corner] = rasterized(job);
  const Image& image = picture.image;
  // Both are cut to what they show.
  const double height = (picture.corner.imag() - corner.imag()) * job.pixels_per_unit;
  const int right = static_cast<int>(
                std::lround((picture.corner.real() - corner.real()) * job.pixels_per_unit)),
            down = checker.height - image.height - static_cast<int>(std::lround(height));
  std::vector<bool> inside;
  for (int r = down; r < down + image.height; ++r)
    for (int c = right; c < right + image.width; ++c)
      inside.push_back(c >= 0 && c < checker.width && r >= 0 && r < checker.height &&
                       checker.at(c, r)[3] == 255);
  return inside;
}

}  // namespace

TexturedSurface textured(const LaidSurface& surface, const Scene& scene, const Image* source,
                         double scale) {
  // Of the picture, more than an outline is missed by; and px that filters look at.
  constexpr double kReach = 0.02, kFilter = 4;
  if (!source || !scene.has_cage())
    throw Error(ErrorKind::bad_input, "a texture needs a picture and a cage");
  const auto prepared = prepared_map(scene, Precision::single, MeshOptions{});
  SampledMap map;
  prepared->deformer->deform(pose_of(scene), map, {});
  RasterJob job;
  job.mesh = prepared->mesh.get();
  job.positions = {map.f.data(), static_cast<size_t>(map.f.size())};
  job.source = source;
  job.pixels_per_unit = scale;
  job.surroundings = false;
  RasterResult drawn = rasterized(job);
  bleed(drawn.image, covered(job, drawn),
        kReach * std::max(drawn.image.width, drawn.image.height) + kFilter);
  TexturedSurface result{std::move(drawn.image), {}};
  const double width = result.texture.width / scale, height = result.texture.height / scale;
  for (const Complex& z : surface.plane) {
    const double u = (z.real() - drawn.corner.real()) / width,
                 v = (z.imag() - drawn.corner.imag()) / height;
    // Beyond the picture it is transparent, as its edge is there.
    result.coordinates.push_back({std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)});
  }
  return result;
}

void write_textured(const std::filesystem::path& path, const LaidSurface& surface,
                    const TexturedSurface& textured) {
  Path material = path, texture = path;
  material.replace_extension(".mtl");
  texture.replace_extension(".png");
  write_file(texture, encode_png(textured.texture));
  write_file(material, material_of(texture.filename().string()));
  write_file(path, obj_of(surface.surface, textured.coordinates, material.filename().string()));
}

}  // namespace holomorph
