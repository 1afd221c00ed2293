// The conformal flattening of a surface in space. Part of the mesher: CGAL solves.
#pragma once

#include "core/mesh/surface.h"

namespace holomorph {

enum class Flattening {
  lscm,    ///< least squares conformal maps (Levy et al. 2002): the boundary finds its own shape
  circle,  ///< discrete conformal (Eck et al. 1995), the boundary on a circle by arc length
};

/// "lscm", "circle". The second throws Error for other names.
std::string name_of(Flattening flattening);
Flattening flattening_named(const std::string& name);

/// Where the vertices go in the plane: counter-clockwise, of the surface's area, turned so that the
/// surface's y goes up on average, its box's lower left corner at the origin. Throws Error for what
/// disk_boundary refuses and for surfaces that fold when they are flattened. Cost: a sparse
/// factorisation, about 50 us a vertex for thousands, 200 us for half a million.
Points flattened(const Surface& surface, Flattening how);

}  // namespace holomorph
