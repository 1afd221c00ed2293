// A flattened surface in the picture's plane: what its texture is made of.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/deformation.h"
#include "scene/formats/surface_file.h"

namespace holomorph {

/// A surface and where its vertices lie in the plane. Value type.
struct LaidSurface {
  Surface surface;
  Points plane;

  /// The boundary there, counter-clockwise: what a picture's shape is taken onto.
  Points outline() const;
};

/// Flattened, moved and scaled so that its box has the middle and the diagonal of `onto`. Throws
/// Error as flattened does.
LaidSurface laid_onto(const Surface& surface, Flattening how, const Box& onto);

/// Turned, scaled and moved so that its boundary is this outline, to 1e-6 of the outline's size.
/// Throws Error when it is of another shape.
LaidSurface laid_along(LaidSurface laid, const Points& outline);

/// The deformation's surface, read from its file and laid along the outline. Throws Error when
/// there is none, for what the file is not, and when the outline is not its boundary.
LaidSurface laid_surface_of(const Deformation& deformation);

/// The boundary of a surface's texture coordinates in a picture of this size: the cage of what the
/// surface shows. Throws Error when it has no such coordinates, or is no disk.
Points texture_boundary(const SurfaceFile& file, int width, int height);

}  // namespace holomorph
