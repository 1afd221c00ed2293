// SVG paths and pictures are first converted to cages, to reuse the code that reads, traces and
// checks cages.
#include "scene/formats/outline_import.h"

#include "core/outline/outline_match.h"
#include "scene/auto_cage.h"
#include "scene/flattened_surface.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/svg_path.h"

namespace holomorph {
namespace {

constexpr int kVertices = 120;       ///< vertices of the cage around a traced picture
constexpr Index kMostPoints = 4000;  ///< points; longer outlines are resampled at equal steps

Points fitted(Points points, const Box& onto) {
  const Box box = box_of(points);
  const double scale = onto.diagonal() / box.diagonal();
  for (Complex& z : points) z = onto.center() + scale * (z - box.center());
  return points;
}

}  // namespace

Points outline_of_file(const Path& path, double height, const Box& onto, Flattening how) {
  const std::string name = path.string(), bytes = read_file(path);
  try {
    Points outline;
    if (is_named_as(path, FileContent::path)) {
      outline = flattened(cage_of_svg(bytes, name, height, PathUse::outline)).points;
    } else if (is_named_as(path, FileContent::surface)) {
      outline = flattened_onto(surface_of_obj(bytes, name).surface, how, onto).outline();
    } else {
      const Image image = decode_image(bytes, name);
      constexpr double kNoHoles = 100;
      const Cage cage = auto_cage(
          image, {.vertices = kVertices, .margin = 0, .hole_width = kNoHoles, .curved = true});
      outline = fitted(flattened(cage).points, onto);
    }
    // The number of points identifies a surface's boundary, so it is not resampled.
    if (!is_named_as(path, FileContent::surface) &&
        static_cast<Index>(outline.size()) > kMostPoints)
      outline = at_equal_lengths(Polyline(outline, true), kMostPoints);
    check_outline(outline);
    return outline;
  } catch (const Error& error) {
    throw about(path, error);
  }
}

std::optional<SurfaceReference> surface_of_file(const Path& path, Flattening how) {
  if (!is_named_as(path, FileContent::surface)) return {};
  return SurfaceReference{absolute_path(path).string(), how};
}

}  // namespace holomorph
