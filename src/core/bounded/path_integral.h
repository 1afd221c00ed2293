// The map of given derivatives along straight lines, to rounding.
#pragma once

#include "core/bounded/certificate.h"
#include "core/cauchy/boundary_basis.h"

namespace holomorph {

/// A straight line inside the domain.
struct Line {
  Complex from, to;
};

/// What f = Phi + conj(Psi) grows by along each line. Gauss-Legendre panels are no longer than they
/// are far from the basis' polygon, outside of which its functions are not defined: the error is
/// that of rounding. Cost: 12 rows of the basis for each panel.
VectorXc growth_along(const BoundaryBasis& basis, const LogMap& map, std::span<const Line> lines);

/// Phi' and conj(Psi') at points.
struct Slopes {
  VectorXc fz, fzbar;
};
Slopes slopes_at(const BoundaryBasis& basis, const LogMap& map, std::span<const Complex> points);

}  // namespace holomorph
