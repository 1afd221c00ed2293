// A flattened surface in the picture's plane: what its texture is made of.
#pragma once

#include "core/mesh.h"
#include "scene/surface_file.h"

namespace holomorph {

/// A surface and where its vertices lie in the plane.
struct LaidSurface {
  Surface surface;
  Points plane;

  /// The boundary there, counter-clockwise: what a picture's shape is taken onto.
  Points outline() const;
};

/// Flattened, moved and scaled so that its box has the middle and the diagonal of `onto`. Throws
/// Error as flattened does.
LaidSurface laid_onto(const Surface& surface, Flattening how, const Box& onto);

/// Flattened so that its boundary is this outline, up to a similarity. Throws Error when that is
/// none of a laid surface.
LaidSurface laid_along(const Surface& surface, const Points& outline);

/// The boundary of a surface's texture coordinates in a picture of this size: the cage of what the
/// surface shows. Throws Error when it has no such coordinates, or is no disk.
Points texture_boundary(const SurfaceFile& file, int width, int height);

}  // namespace holomorph
