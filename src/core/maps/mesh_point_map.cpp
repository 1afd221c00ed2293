// The derivatives are constant in each triangle.
#include "core/maps/mesh_point_map.h"

#include "core/maps/distortion.h"

namespace holomorph {

MeshPointMap::MeshPointMap(std::shared_ptr<const Mesh> mesh, VectorXc f)
    : mesh_(std::move(mesh)), locator_(*mesh_), f_(std::move(f)) {}

PointMap::Value MeshPointMap::at(Complex z) const {
  const Location place = locator_.near(z);
  const Triangle& t = mesh_->triangles[static_cast<size_t>(place.triangle)];
  const auto [fz, fzbar] = derivatives_in(*mesh_, t, f_);
  return {place.in(*mesh_, as_span(f_)), fz, fzbar};
}

}  // namespace holomorph
