// The scene knows the outline only; a surface is found again by it.
#include "scene/laid_surface.h"

#include "core/error.h"
#include "core/similarity.h"

namespace holomorph {
namespace {

Points along(const std::vector<int>& loop, const Points& places) {
  Points points;
  for (const int v : loop) points.push_back(places[static_cast<size_t>(v)]);
  return points;
}

}  // namespace

Points LaidSurface::outline() const {
  return along(disk_boundary(surface), plane);
}

LaidSurface laid_onto(const Surface& surface, Flattening how, const Box& onto) {
  LaidSurface laid{surface, flattened(surface, how)};
  const Box box = box_of(laid.plane);
  const double scale = onto.diagonal() / box.diagonal();
  for (Complex& z : laid.plane) z = onto.center() + scale * (z - box.center());
  return laid;
}

LaidSurface laid_along(const Surface& surface, const Points& outline) {
  constexpr double kSame = 1e-6;  // of the outline's size
  const std::vector<int> loop = disk_boundary(surface);
  for (const Flattening how : {Flattening::lscm, Flattening::circle}) {
    if (outline.size() != loop.size()) break;
    Points flat;
    try {
      flat = flattened(surface, how);
    } catch (const Error&) {
      continue;  // it may have been the other one
    }
    const Points boundary = along(loop, flat);
    const Similarity onto = similarity_between(boundary, outline);
    double off = 0;
    for (size_t i = 0; i < outline.size(); ++i)
      off = std::max(off, std::abs(onto(boundary[i]) - outline[i]));
    if (!(off <= kSame * box_of(outline).diagonal())) continue;
    for (Complex& z : flat) z = onto(z);
    return {surface, std::move(flat)};
  }
  throw Error(ErrorKind::bad_input,
              "the scene's outline is not this surface's boundary; take the outline from the "
              "surface, and do not bend it");
}

Points texture_boundary(const SurfaceFile& file, int width, int height) {
  const std::vector<int> loop = disk_boundary(file.surface);
  if (file.texture.empty())
    throw Error(ErrorKind::bad_input, "the surface has no texture coordinates of its own");
  Points boundary = along(loop, file.texture);
  for (Complex& z : boundary) z = {z.real() * width, z.imag() * height};
  return boundary;
}

}  // namespace holomorph
