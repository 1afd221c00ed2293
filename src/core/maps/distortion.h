// How a map distorts lengths, angles and areas, and whether it folds.
#pragma once

#include "core/maps/deformer.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// Distortion at the samples of a map, with sigma_max = |f_z| + |f_zbar| and sigma_min = |f_z| -
/// |f_zbar|.
struct Distortion {
  Eigen::VectorXd k;        ///< angle: |f_zbar| / |f_z|; 0 where conformal, 1 where degenerate
  Eigen::VectorXd area;     ///< log2 of sigma_max * sigma_min; -inf unless orientation-preserving
  Eigen::VectorXd stretch;  ///< max(sigma_max, 1 / sigma_min)
};
/// Requires a map that was sampled with its derivatives. Cost: linear.
Distortion distortion_of(const SampledMap& map);

/// The number of triangles that are flipped, degenerate or not finite when the vertices are at f.
int flipped_triangles(const Mesh& mesh, const VectorXc& f);

/// Whether nothing folds: no triangle is flipped, and the triangles around each inner vertex close
/// after one turn. Cost: linear.
bool is_immersion(const Mesh& mesh, const VectorXc& f);

/// Measurements of a whole map on a mesh.
struct MapReport {
  double max_k = 0, min_sigma = 0, max_sigma = 0;
  Points zeros;  ///< centers of rest triangles that contain zeros of f_z
  /// How often the boundary's image turns around. It is 1 if is_immersion() is true, although the
  /// picture may then overlap itself at a vertex of the boundary.
  double turning_number = 0;
  bool simple_boundary = true;
  int flipped_triangles = 0;
  /// Whether no fold was found: f_z has no zeros, the turning number is one, and no triangle is
  /// flipped. This is a measurement at the samples, not a proof.
  bool locally_injective() const;
};
/// `map` holds values and derivatives at mesh.vertices. Zeros are found by the argument principle
/// on every triangle. Cost: linear, except for the crossing test of the boundary.
MapReport report_of(const Mesh& mesh, const SampledMap& map);
/// Like report_of, for the piecewise linear map with the values f at the mesh's vertices. k and
/// sigma are the extremes over the triangles.
MapReport report_of_linear(const Mesh& mesh, const VectorXc& f);

/// The symmetric Dirichlet energy of the piecewise linear map with the values f at the mesh's
/// vertices: the mean over the area of half the sum of both stretches squared and of their inverses
/// squared. It is 2 for rigid motions, and infinite if a triangle is flipped.
double isometric_energy_of(const Mesh& mesh, const VectorXc& f);

/// f_z and f_zbar, in triangle t, of the piecewise linear map with the values f at the mesh's
/// vertices.
struct LinearDerivatives {
  Complex fz, fzbar;
};
LinearDerivatives derivatives_in(const Mesh& mesh, const Triangle& t, const VectorXc& f);

/// f_z and f_zbar, at the vertices, of the piecewise linear map with the values f there. They are
/// area-weighted means over the triangles around each vertex. Cost: linear.
struct VertexDerivatives {
  VectorXc fz, fzbar;
};
VertexDerivatives vertex_derivatives(const Mesh& mesh, const VectorXc& f);

}  // namespace holomorph
