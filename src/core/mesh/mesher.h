// The triangle mesh of the inside of a cage. Part of the mesher library, since it uses CGAL.
#pragma once

#include <functional>

#include "core/mesh/mesh.h"

namespace holomorph {

/// How fine a domain mesh is.
struct MeshOptions {
  /// Target number of vertices. For ordinary cages, the actual number is within about a third of
  /// it.
  int vertices = 8000;
};

/// Meshes the inside of a simple polygon of any orientation with conforming Delaunay triangles,
/// which are smaller near the boundary. Every cage vertex is a mesh vertex with the same
/// coordinates. Slivers, collinear and nearly repeated vertices are allowed. A needle-sharp corner
/// of the polygon produces needle-sharp triangles. Refinement stops at about three times the target
/// number of vertices. Throws Error for polygons that check_rest_cage rejects. Cost: about 4 us per
/// vertex.
Mesh domain_mesh(PolygonView polygon, const MeshOptions& options = {});

/// Meshes the inside of a rest cage. The parts of a cage have about as many vertices as their areas
/// suggest, but at least a hundredth of all. The vertices of the cage are mesh vertices, and every
/// boundary vertex lies on the curves of the cage. The outline of the mesh follows the curves to
/// within 5e-5 of the cage's size.
Mesh domain_mesh(const Cage& cage, const MeshOptions& options = {});

/// A mesh whose edges have about the lengths, which must be positive, that a function gives for
/// points of the cage, which must have one part. Lengths that would change by more than 0.3 times
/// the way between two points are shortened. If there would be more than `most` vertices, all edges
/// are longer by the same factor. Cost: also about 2,500 calls of the function.
Mesh graded_mesh(const Cage& cage, const std::function<double(Complex)>& length_at, int most);

}  // namespace holomorph
