// Outlines that others drew: an SVG's path, what is opaque in a picture, a surface's boundary.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/deformation.h"
#include "system/file.h"

namespace holomorph {

/// The closed curve in a file, fit for Deformation::outline. Of an SVG it is the path that
/// cage_of_svg reads, in plane coordinates for a picture of this height. Of a picture it is the
/// outline of the largest connected part that is not transparent, moved and scaled so that its box
/// has the middle and the diagonal of `onto`. Of a surface (.obj) it is the boundary of its
/// flattening, laid in the same way. Throws Error{bad_input} for what cannot be read or is no
/// outline.
Points outline_of_file(const Path& path, double height, const Box& onto,
                       Flattening how = Flattening::lscm);

/// The reference to a file that is a surface (.obj), by its absolute path; none for others.
std::optional<SurfaceReference> surface_of_file(const Path& path, Flattening how);

}  // namespace holomorph
