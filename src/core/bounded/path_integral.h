// Integrates the derivatives of a map along straight lines, accurate to rounding error.
#pragma once

#include <functional>

#include "core/bounded/certificate.h"
#include "core/cauchy/boundary_basis.h"
#include "core/mesh/antiderivative.h"

namespace holomorph {

/// Phi' and Psi' of a map at points, from the values C of the basis there, one row for each point.
using DerivativesAt = std::function<Derivatives(const MatrixXc& c)>;
DerivativesAt evaluator_of(LogMap map);

/// A straight line segment inside the domain.
struct Line {
  Complex from, to;
};

/// A node of the quadrature along one of several lines, and its weight times the line's direction.
struct LineNode {
  Index line;
  Complex weight;
};

/// The increment of f = Phi + conj(Psi) along each line. The functions are defined only inside the
/// basis' polygon. Each Gauss-Legendre panel is shorter than its distance from that polygon, which
/// reduces the error to the level of rounding. Cost: 12 rows of the basis for each panel.
VectorXc increments_along(const BoundaryBasis& basis, const DerivativesAt& map,
                          std::span<const Line> lines);

/// The same for many maps along the same lines. Cost: the rows above once, then a product with them
/// for each map.
class LineIntegrals {
 public:
  LineIntegrals() = default;
  LineIntegrals(const BoundaryBasis& basis, std::span<const Line> lines);

  VectorXc of(const DerivativesAt& map) const;

 private:
  Index count_ = 0;
  std::vector<LineNode> nodes_;
  MatrixXc values_;  ///< C at the nodes
};

/// f = Phi + conj(Psi) at the vertices of a tree's mesh, 0 at its root. Cost: at least 12 rows of
/// the basis for each edge of the tree.
VectorXc integrated_along(const MeshTree& tree, const BoundaryBasis& basis, const LogMap& map);

/// Phi' and conj(Psi') at points.
struct Slopes {
  VectorXc fz, fzbar;
};
Slopes slopes_at(const BoundaryBasis& basis, const DerivativesAt& map,
                 std::span<const Complex> points);

}  // namespace holomorph
