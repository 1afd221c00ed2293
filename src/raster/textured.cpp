// The picture is the texture: no pixel is sampled twice.
#include "raster/textured.h"

#include <algorithm>

#include "scene/file.h"

namespace holomorph {

TexturedSurface textured(const LaidSurface& surface, const Scene& scene, const Image* source,
                         double scale) {
  RasterResult drawn = picture_of(scene, source, {View::image, scale});
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
