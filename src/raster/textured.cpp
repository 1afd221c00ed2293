// The posed picture itself becomes the texture, so no pixel is resampled a second time.
#include "raster/textured.h"

#include <algorithm>

#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/mesh/mesher.h"
#include "raster/bleed.h"
#include "raster/raster.h"
#include "scene/prepared_map.h"
#include "system/file.h"
#include "system/new_file.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Which pixels the posed map covers completely: the pixels that are opaque when the map is drawn
/// as a checker.
std::vector<bool> covered(RasterJob job) {
  job.view = View::checker;
  const Image checker = rasterized(job).image;
  std::vector<bool> inside;
  for (size_t i = 3; i < checker.pixels.size(); i += 4) inside.push_back(checker.pixels[i] == 255);
  return inside;
}

}  // namespace

TexturedSurface textured(const FlattenedSurface& surface, const Deformation& deformation,
                         const Image* source, double scale) {
  // kReach is a fraction of the texture's size, larger than the error of most outlines. kFilter is
  // the reach of texture filters in pixels.
  constexpr double kReach = 0.03, kFilter = 2;
  if (!source || !deformation.has_cage())
    throw Error(ErrorKind::bad_input, "a texture needs a scene with a picture and a cage");
  const auto prepared = prepared_map(deformation, Precision::single, MeshOptions{});
  SampledMap map = prepared->deformer->deform(pose_of(deformation), {});
  RasterJob job;
  job.mesh = prepared->mesh.get();
  job.positions = as_span(map.f);
  job.source = source;
  job.pixels_per_unit = scale;
  job.surroundings = false;
  Box box = box_of(surface.plane);
  const Complex margin = Complex(1, 1) * (kFilter + 1) / scale;
  const Complex low(box.left, box.bottom), high(box.right, box.top);
  box.include(low - margin);
  box.include(high + margin);
  job.region = box;
  RasterResult drawn = rasterized(job);
  const int rows = drawn.image.height;
  const double width = drawn.image.width / scale, height = rows / scale;
  const Polyline edge(surface.outline(), true);
  const auto is_shown = [&](int c, int r) {
    const Complex z = drawn.corner + Complex(c + 0.5, rows - r - 0.5) / scale;
    return edge.nearest(z).distance * scale <= kFilter || winding_number(edge.points(), z) != 0;
  };
  bleed(drawn.image, covered(job), kReach * std::max(drawn.image.width, rows) + 2 * kFilter,
        is_shown);
  TexturedSurface result{std::move(drawn.image), {}};
  for (const Complex& z : surface.plane) {
    const Complex at = z - drawn.corner;
    result.coordinates.push_back({at.real() / width, at.imag() / height});
  }
  return result;
}

std::array<Path, 3> files_of_textured(const Path& path) {
  const auto with = [&](const char* extension) { return Path(path).replace_extension(extension); };
  return {path, with(".mtl"), with(".png")};
}

void write_textured(const std::filesystem::path& path, const FlattenedSurface& surface,
                    const TexturedSurface& textured) {
  if (lower_case(path.extension().string()) != ".obj")
    throw Error(ErrorKind::bad_input,
                path.string() + ": a textured surface is an OBJ file; end the name with .obj");
  const auto [obj, material, texture] = files_of_textured(path);
  write_file(texture, encode_png(textured.texture));
  write_file(material, material_of(texture.filename().string()));
  write_file(obj, obj_of(surface.surface, textured.coordinates, material.filename().string()));
}

}  // namespace holomorph
