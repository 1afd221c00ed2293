// Gauss-Legendre rules on [0, 1].
#pragma once

#include <vector>

namespace holomorph {

/// Nodes and weights. A rule with n nodes is exact for polynomials up to degree 2 n - 1.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// The rule with the given number of nodes, 1 to 64. Each rule is computed once, in extended
/// precision.
const GaussRule& gauss_rule(int nodes);

}  // namespace holomorph
