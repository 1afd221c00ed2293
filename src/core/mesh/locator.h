// Finds the triangles of a mesh that contain points, by a grid of cells.
#pragma once

#include "core/geometry/box_grid.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// Gives the same answers as `locate` and `locate_near` at the rest positions of a mesh, for many
/// points. Threads: const functions may run at the same time.
class MeshLocator {
 public:
  /// The mesh must outlive the locator. Cost: linear in the number of triangles.
  explicit MeshLocator(const Mesh& mesh);

  /// Cost: a few triangles, if they have similar sizes.
  std::optional<Location> at(Complex z) const;
  /// Cost: for points outside the mesh, as `locate_near`.
  Location near(Complex z) const;
  /// The vertex nearest to z among those of the triangle `near(z)`.
  int vertex_near(Complex z) const;

 private:
  const Mesh& mesh_;
  BoxGrid grid_;
  /// The triangles whose boxes touch each cell, cell by cell, and where each cell's begin.
  std::vector<int> triangles_, first_;
};

}  // namespace holomorph
