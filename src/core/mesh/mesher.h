// The triangle mesh of a cage's inside. Part of the mesher: CGAL refines.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// How fine a domain mesh is.
struct MeshOptions {
  /// Intended number of vertices; what comes out is within about a third of it for ordinary
  /// cages.
  int vertices = 8000;
};

/// Meshes the inside of a simple polygon of either orientation: conforming Delaunay triangles,
/// smaller near the boundary. Every cage vertex is a mesh vertex with the same coordinates.
/// Slivers, collinear and nearly repeated vertices are fine: where the polygon itself is
/// needle-sharp the triangles are too, and refinement stops at about three times the wanted number
/// of vertices. Throws Error for what check_rest_cage refuses. Cost: about 4 us per vertex.
Mesh domain_mesh(std::span<const Complex> polygon, const MeshOptions& options = {});

/// Meshes the inside of a rest cage. Its vertices are mesh vertices; every boundary vertex lies on
/// the cage's curves, so that the mesh's outline follows them to 5e-5 of the cage's size.
Mesh domain_mesh(const Cage& cage, const MeshOptions& options = {});

}  // namespace holomorph
