// A map with continuous derivatives through given values and derivatives at a mesh's vertices.
//
// Each triangle is divided at its center into three, on which the map is cubic (Clough, Tocher
// 1965). The derivative across an edge is linear along it, so that neighbors agree there.
#pragma once

#include "core/maps/deformer.h"
#include "core/maps/triangle_cubic.h"
#include "core/mesh/locator.h"
#include "core/sheet/vertex_gradients.h"

namespace holomorph {

/// A cubic on each third of a triangle: third k has corner k + 1, corner k + 2 and the center,
/// whose barycentric coordinates are u, v and w.
using CubicThirds = std::array<TriangleCubic, 3>;

/// Proved bounds on the stretches and on the Jacobian determinant of a map in a region.
struct StretchBounds {
  double smallest = 0, largest = 0;  ///< lower and upper bound
  double least_determinant = 0;      ///< lower bound
};

/// The value at a point as a sum of values at vertices with real weights, where derivatives are
/// recovered by `gradients`.
std::vector<std::pair<int, double>> smooth_row(const Mesh& mesh, const VertexGradients& gradients,
                                               const Location& location);

class SmoothMap final : public PointMap {
 public:
  /// Values and derivatives at the mesh's vertices.
  SmoothMap(std::shared_ptr<const Mesh> mesh, const VectorXc& f, const VectorXc& fz,
            const VectorXc& fzbar);

  Value at(Complex z) const override;
  Value at(const Location& location) const;

  /// Bounds in a triangle from the Bernstein coefficients of the derivatives, which enclose them.
  /// Thirds are divided up to `depth` times where this may improve the bounds.
  StretchBounds bounds(size_t triangle, int depth) const;
  const CubicThirds& cubics(size_t triangle) const { return cubics_[triangle]; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  std::vector<CubicThirds> cubics_;
  MeshLocator locator_;
};

}  // namespace holomorph
