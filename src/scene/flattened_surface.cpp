// The deformation stores only the boundary, which determines the positions of all other vertices.
#include "scene/flattened_surface.h"

#include "core/error.h"
#include "core/geometry/similarity.h"
#include "core/mesh/flatten.h"
#include "system/file.h"

namespace holomorph {
namespace {

Points along(const std::vector<int>& loop, const Points& places) {
  Points points;
  for (const int v : loop) points.push_back(places[static_cast<size_t>(v)]);
  return points;
}

}  // namespace

Points FlattenedSurface::outline() const {
  return along(disk_boundary(surface), plane);
}

FlattenedSurface flattened_onto(const Surface& surface, Flattening how, const Box& onto) {
  FlattenedSurface laid{surface, flattened(surface, how)};
  const Box box = box_of(laid.plane);
  const double scale = onto.diagonal() / box.diagonal();
  for (Complex& z : laid.plane) z = onto.center() + scale * (z - box.center());
  return laid;
}

FlattenedSurface aligned_with_outline(FlattenedSurface laid, const Points& outline) {
  constexpr double kSame = 1e-6;  // of the outline's size
  const Points boundary = laid.outline();
  double off = INFINITY;
  if (outline.size() == boundary.size()) {
    const Similarity onto = similarity_between(boundary, outline);
    off = 0;
    for (size_t i = 0; i < outline.size(); ++i)
      off = std::max(off, std::abs(onto(boundary[i]) - outline[i]));
    for (Complex& z : laid.plane) z = onto(z);
  }
  if (!(off <= kSame * box_of(outline).diagonal()))
    throw Error(ErrorKind::bad_input,
                "the scene's outline is not this surface's boundary; import the outline from the "
                "surface, and then only move, rotate or scale it");
  return laid;
}

FlattenedSurface flattened_surface_of(const Deformation& deformation) {
  if (!deformation.surface)
    throw Error(ErrorKind::bad_input,
                "the scene has no surface; import its outline from an OBJ file first");
  const auto& [file, flattening, extra] = *deformation.surface;
  try {
    Surface surface = surface_of_obj(read_file(file), file).surface;
    Points flat = flattened(surface, flattening);
    return aligned_with_outline({std::move(surface), std::move(flat)}, deformation.outline);
  } catch (const Error& error) {
    throw about(file, error);
  }
}

Points texture_boundary(const SurfaceFile& file, const Box& page) {
  const std::vector<int> loop = disk_boundary(file.surface);
  if (file.texture.empty())
    throw Error(ErrorKind::bad_input, "the surface has no texture coordinates");
  Points boundary = along(loop, file.texture);
  for (Complex& z : boundary)
    z = {page.left + z.real() * page.width(), page.bottom + z.imag() * page.height()};
  return boundary;
}

}  // namespace holomorph
