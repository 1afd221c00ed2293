// Gauss-Legendre rules on [0, 1].
#pragma once

#include <vector>

namespace holomorph {

/// Nodes and weights: exact for polynomials of degree 2 n - 1.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// The rule with 1 to 64 nodes, computed in extended precision once.
const GaussRule& gauss_rule(int nodes);

}  // namespace holomorph
