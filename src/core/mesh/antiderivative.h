// Functions from their derivatives, along a tree of mesh edges.
#pragma once

#include <optional>

#include "core/mesh/mesh.h"

namespace holomorph {

/// The order in which a mesh's vertices are reached from one another, breadth first from a vertex
/// in the middle, or from a given one. Domains are simply connected: every way gives the same
/// antiderivative.
class MeshTree {
 public:
  /// The mesh must outlive this. Cost: linear.
  explicit MeshTree(const Mesh& mesh, std::optional<int> root = {});

  /// F at the vertices, with F = 0 at the root, from F' and F'' there, by the trapezoidal rule with
  /// Hermite's correction, h / 2 (F'_0 + F'_1) + h^2 / 12 (F''_0 - F''_1): exact for cubics. Cost:
  /// linear, 3 ns a vertex.
  VectorXc antiderivative(const VectorXc& derivative, const VectorXc& second) const;

  struct Edge {
    int from, to;
  };
  int root() const { return root_; }
  /// In an order in which each starts at the root or where an earlier one ends.
  const std::vector<Edge>& edges() const { return edges_; }

 private:
  const Mesh& mesh_;
  int root_ = 0;
  std::vector<Edge> edges_;
};

}  // namespace holomorph
