// A flattened surface, placed in the plane of the picture. This placement is used to render the
// surface's texture.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/deformation.h"
#include "scene/formats/surface_file.h"

namespace holomorph {

/// A surface and the positions of its vertices in the plane. Value type.
struct FlattenedSurface {
  Surface surface;
  Points plane;

  /// The boundary in the plane, counter-clockwise: the target outline for the picture.
  Points outline() const;
};

/// Flattens a surface, then moves and scales it to give its bounding box the same center and
/// diagonal as `onto`. Throws the same errors as flattened().
FlattenedSurface flattened_onto(const Surface& surface, Flattening how, const Box& onto);

/// Rotates, scales and moves the surface to make its boundary coincide with this outline, within
/// 1e-6 of the outline's size. Throws Error if the boundary has a different shape.
FlattenedSurface aligned_with_outline(FlattenedSurface laid, const Points& outline);

/// The deformation's surface, read from its file and placed along the outline. Throws Error if
/// there is no surface, if the file is not a valid surface, or if the outline is not the surface's
/// boundary.
FlattenedSurface flattened_surface_of(const Deformation& deformation);

/// The boundary of a surface's texture coordinates on a page. It is a cage around the part of the
/// picture used by the texture. Throws Error if the surface has no texture
/// coordinates or is not a disk.
Points texture_boundary(const SurfaceFile& file, const Box& page);

}  // namespace holomorph
