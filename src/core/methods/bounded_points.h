// Evaluates a bounded map at arbitrary points by integrating from a vertex of the triangle that
// contains the point.
#pragma once

#include "core/bounded/path_integral.h"
#include "core/maps/deformer.h"
#include "core/mesh/locator.h"

namespace holomorph {

/// A map that takes its derivatives from `map` and has the values f at the mesh's vertices.
class BoundedPointMap final : public PointMap {
 public:
  BoundedPointMap(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
                  DerivativesAt map, VectorXc f)
      : basis_(std::move(basis)),
        mesh_(std::move(mesh)),
        locator_(*mesh_),
        map_(std::move(map)),
        f_(std::move(f)) {}

  bool has_no_zeros() const override { return true; }
  Value at(Complex z) const override {
    const SampledMap map = at(std::span(&z, 1));
    return {map.f[0], map.fz[0], map.fzbar[0]};
  }

  std::vector<Value> values_at(std::span<const Complex> points) const override {
    const SampledMap map = at(points);
    std::vector<Value> values;
    for (Index i = 0; i < map.f.size(); ++i) values.push_back({map.f[i], map.fz[i], map.fzbar[i]});
    return values;
  }

  const VectorXc& at_vertices() const { return f_; }
  /// Adds a translation to the map.
  void move(Complex by) { f_.array() += by; }

  SampledMap at(std::span<const Complex> points) const {
    SampledMap map;
    map.f.resize(static_cast<Index>(points.size()));
    std::vector<Line> lines;
    for (size_t i = 0; i < points.size(); ++i) {
      const int from = locator_.vertex_near(points[i]);
      lines.push_back({mesh_->vertices[static_cast<size_t>(from)], points[i]});
      map.f[static_cast<Index>(i)] = f_[from];
    }
    map.f += increments_along(*basis_, map_, lines);
    Slopes slopes = slopes_at(*basis_, map_, points);
    map.fz = std::move(slopes.fz);
    map.fzbar = std::move(slopes.fzbar);
    return map;
  }

 private:
  std::shared_ptr<const BoundaryBasis> basis_;
  std::shared_ptr<const Mesh> mesh_;
  MeshLocator locator_;
  DerivativesAt map_;
  VectorXc f_;
};

}  // namespace holomorph
