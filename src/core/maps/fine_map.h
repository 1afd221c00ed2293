// A map on triangles so small that it is linear in each of them, up to a tolerance.
//
// The map itself is evaluated, with its derivatives, only where a cubic in each triangle does not
// yet agree with it. The cubics are then divided into linear pieces, which costs little per piece.
#pragma once

#include <functional>

#include "core/maps/deformer.h"

namespace holomorph {

/// A mesh at rest, and the images of its vertices.
struct FineMap {
  Mesh mesh;
  Points f;
  /// The largest error of the cubics that was found at the middle of an edge. It exceeds the
  /// tolerance only at points where the map's derivative is infinite and edges would become shorter
  /// than 1e-10 of the mesh.
  double error = 0;
  size_t evaluations = 0;  ///< of the map
};

/// Divides the triangles of a mesh until linear interpolation between the vertices' images is
/// within `tolerance` of the map, in units of the plane. Triangles keep their order: the pieces of
/// one come before the pieces of the next. The boundary follows the cage to within the same
/// tolerance. Triangles with images that are not finite are left out. `values_at` gives the map at
/// many points, and may use several threads; an exception from it ends the work. `is_piecewise`:
/// see PointMap. Throws Error for more than 20 million triangles. Cost: about four
/// evaluations of the map per vertex of the mesh, and 50 ns per piece.
FineMap fine_map(const Cage& rest, const Mesh& mesh, double tolerance, const PointValues& values_at,
                 bool is_piecewise = false);

}  // namespace holomorph
