// Integrates derivatives along a tree of mesh edges.
#pragma once

#include <optional>

#include "core/mesh/mesh.h"

namespace holomorph {

/// A spanning tree of the edges of a mesh, built breadth-first from a given vertex or, by default,
/// from a vertex near the center. In a domain without holes, every path gives the same
/// antiderivative.
class MeshTree {
 public:
  /// The mesh must outlive the tree. Cost: linear.
  explicit MeshTree(const Mesh& mesh, std::optional<int> root = {});

  /// Computes F at the vertices from F' and F'' at the vertices, with F = 0 at the root. Uses the
  /// trapezoidal rule with the Hermite correction, h / 2 (F'_0 + F'_1) + h^2 / 12 (F''_0 - F''_1),
  /// which is exact for cubic F'. Cost: linear, 3 ns per vertex.
  VectorXc antiderivative(const VectorXc& derivative, const VectorXc& second) const;

  /// The argument of z - center at the vertices, in radians, continuous along the edges of the
  /// tree.
  VectorXd argument(Complex center) const;

  struct Edge {
    int from, to;
  };
  const Mesh& mesh() const { return mesh_; }
  int root() const { return root_; }
  /// The edges of the tree. Each edge starts at the root or at the end of an earlier edge.
  const std::vector<Edge>& edges() const { return edges_; }

 private:
  const Mesh& mesh_;
  int root_ = 0;
  std::vector<Edge> edges_;
};

}  // namespace holomorph
