// Recovers the derivatives of a function at the vertices of a mesh from its values there.
#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <span>

#include "core/mesh/mesh.h"

namespace holomorph {

/// f_z and f_zbar at each vertex, as sums of the values at vertices nearby: those of the quadratic
/// through the vertex that fits its neighbors best, and their neighbors where it has fewer than
/// six. They are exact for quadratics, except where the neighbors do not determine one.
class VertexGradients {
 public:
  /// `framed` marks vertices of the outline; empty: none. Their derivatives along the outline
  /// depend on its vertices alone, so that a side stays straight if its vertices do. Cost: a small
  /// least-squares problem for each vertex.
  explicit VertexGradients(const Mesh& mesh, std::span<const char> framed = {});

  VectorXc fz(const VectorXc& f) const { return weights_ * f; }
  VectorXc fzbar(const VectorXc& f) const { return weights_.conjugate() * f; }
  /// A row for each vertex: the weights of f_z. Those of f_zbar are their conjugates.
  const Eigen::SparseMatrix<Complex, Eigen::RowMajor>& weights() const { return weights_; }

 private:
  Eigen::SparseMatrix<Complex, Eigen::RowMajor> weights_;
};

}  // namespace holomorph
