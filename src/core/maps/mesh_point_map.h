// A map that is linear in each triangle of a mesh.
#pragma once

#include "core/maps/deformer.h"
#include "core/mesh/locator.h"

namespace holomorph {

class MeshPointMap final : public PointMap {
 public:
  /// `f` are the values at the mesh's vertices.
  MeshPointMap(std::shared_ptr<const Mesh> mesh, VectorXc f);

  /// Outside the mesh, continues the map of the nearest triangle.
  Value at(Complex z) const override;

  bool is_linear_in_triangles() const override { return true; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  MeshLocator locator_;
  VectorXc f_;
};

}  // namespace holomorph
