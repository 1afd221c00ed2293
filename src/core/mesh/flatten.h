// The conformal flattening of a surface in space. Part of the mesher library, since it uses CGAL.
#pragma once

#include "core/mesh/surface.h"

namespace holomorph {

enum class Flattening {
  lscm,    ///< least squares conformal maps (Levy et al. 2002): the boundary is free
  circle,  ///< discrete conformal map (Eck et al. 1995), boundary on a circle by arc length
};

/// Converts to and from "lscm" and "circle". flattening_named throws Error for other names.
std::string name_of(Flattening flattening);
Flattening flattening_named(const std::string& name);

/// The positions of the vertices in the plane. The result is counter-clockwise and has the area of
/// the surface. It is rotated to make the surface's y point up on average, and the lower left
/// corner of its bounding box is the origin. Throws Error if disk_boundary rejects the surface or
/// if the flattened surface folds. Cost: a sparse factorization, about 50 us per vertex for
/// thousands of vertices, 200 us for half a million.
Points flattened(const Surface& surface, Flattening how);

}  // namespace holomorph
