// Imports outlines from files: the path in an SVG file, the contour of a picture's content, or the
// boundary of a surface.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/deformation.h"
#include "system/file.h"

namespace holomorph {

/// The closed curve in a file, suitable for Deformation::outline. From an SVG file, it is the path
/// that cage_of_svg reads, in plane coordinates for a picture of this height. From a picture, it is
/// the outline of the largest connected part that is not transparent. From a surface (.obj), it is
/// the boundary of the flattened surface. Outlines of pictures and surfaces are moved and scaled to
/// give their bounding boxes the same center and diagonal as `onto`. Throws Error{bad_input} if the
/// file cannot be read or has no valid outline.
Points outline_of_file(const Path& path, double height, const Box& onto,
                       Flattening how = Flattening::lscm);

/// A reference with the file's absolute path if the file is a surface (.obj). None for other files.
std::optional<SurfaceReference> surface_of_file(const Path& path, Flattening how);

}  // namespace holomorph
