// A bounded map at points that are no mesh vertices: integrated from the nearest vertex.
#pragma once

#include "core/certificate.h"
#include "core/deformer.h"
#include "core/quadrature.h"

namespace holomorph {

/// The map with these derivatives and values f at the mesh's vertices.
class BoundedPointMap final : public PointMap {
 public:
  BoundedPointMap(std::shared_ptr<const BoundaryBasis> basis, std::shared_ptr<const Mesh> mesh,
                  LogMap map, VectorXc f)
      : basis_(std::move(basis)), mesh_(std::move(mesh)), map_(std::move(map)), f_(std::move(f)) {}

  Value at(Complex z) const override { return at(std::span(&z, 1))[0]; }

  /// From the nearest vertices by Gauss-Legendre quadrature of both derivatives.
  std::vector<Value> at(std::span<const Complex> points) const {
    const GaussRule& rule = gauss_rule(8);
    const size_t nodes = rule.nodes.size(), stride = nodes + 1;
    std::vector<size_t> nearest;
    Points places;
    for (const Complex& z : points) {
      const auto from = std::ranges::min_element(mesh_->vertices, {},
                                                 [&](Complex v) { return std::norm(v - z); });
      nearest.push_back(static_cast<size_t>(from - mesh_->vertices.begin()));
      for (const double t : rule.nodes) places.push_back(*from + t * (z - *from));
      places.push_back(z);
    }
    const MatrixXc c = basis_->values(places);
    const Derivatives d = derivatives_of(map_, c * map_.l, c * map_.w);
    std::vector<Value> values;
    for (size_t i = 0; i < points.size(); ++i) {
      const Complex h = points[i] - mesh_->vertices[nearest[i]];
      Complex phi = 0, psi = 0;
      for (size_t g = 0; g < nodes; ++g) {
        const Index at = static_cast<Index>(i * stride + g);
        phi += rule.weights[g] * h * d.phi[at];
        psi += rule.weights[g] * h * d.psi[at];
      }
      const Index last = static_cast<Index>(i * stride + nodes);
      values.push_back({f_[static_cast<Index>(nearest[i])] + phi + std::conj(psi), d.phi[last],
                        std::conj(d.psi[last])});
    }
    return values;
  }

 private:
  std::shared_ptr<const BoundaryBasis> basis_;
  std::shared_ptr<const Mesh> mesh_;
  LogMap map_;
  VectorXc f_;
};

}  // namespace holomorph
