// Outlines from files: the path of an SVG, the opaque part of a picture, the boundary of a surface.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/deformation.h"
#include "system/file.h"

namespace holomorph {

/// The closed curve in a file, suitable for Deformation::outline. From an SVG file it is the path
/// that cage_of_svg reads, in plane coordinates for a picture of this height. From a picture it is
/// the outline of the largest connected part that is not transparent, moved and scaled so that its
/// bounding box has the center and the diagonal of `onto`. From a surface (.obj) it is the boundary
/// of its flattening, placed in the same way. Throws Error{bad_input} if the file cannot be read or
/// has no valid outline.
Points outline_of_file(const Path& path, double height, const Box& onto,
                       Flattening how = Flattening::lscm);

/// A reference, by absolute path, to a file that is a surface (.obj); none for other files.
std::optional<SurfaceReference> surface_of_file(const Path& path, Flattening how);

}  // namespace holomorph
