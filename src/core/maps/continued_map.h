// A map of a mesh, continued to the whole plane.
#pragma once

#include "core/maps/deformer.h"
#include "core/maps/mesh_point_map.h"

namespace holomorph {

/// Inside the mesh, this is another map. Outside, points move with the nearest point of the
/// boundary, turned and scaled like the boundary there, which is continuous except where the
/// nearest point jumps. All values are finite: where the other map has none, this one is linear in
/// the triangles of the mesh.
class ContinuedMap final : public PointMap {
 public:
  /// `f` are the values at the mesh's vertices. The map must outlive this object.
  ContinuedMap(std::shared_ptr<const Mesh> mesh, VectorXc f, const PointMap& map);

  Value at(Complex z) const override { return values_at({&z, 1})[0]; }
  /// Cost: that of the other map, and for points outside, that of finding the nearest edge.
  std::vector<Value> values_at(std::span<const Complex> points) const override;

 private:
  /// The nearest point of the boundary, and how points next to it follow.
  struct Foot {
    Complex at, edge;              ///< the point, and the direction of its edge, of length 1
    Complex factor, factor_speed;  ///< of points next to it, and its derivative along the edge
    bool is_corner = false;        ///< all points near z have the same foot
  };
  Foot foot_of(Complex z) const;
  Value finite_value(Complex z, const Value& value) const;

  std::shared_ptr<const Mesh> mesh_;
  MeshLocator locator_;
  VectorXc f_;
  MeshPointMap linear_;
  const PointMap& map_;
  std::vector<Complex> boundary_;  ///< positions at rest
  std::vector<Complex> factors_;   ///< of the boundary's vertices
};

}  // namespace holomorph
