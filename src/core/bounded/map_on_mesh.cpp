// Integrates along a tree of mesh edges by the trapezoidal rule, with a correction from second
// derivatives.
#include "core/bounded/map_on_mesh.h"

#include "core/bounded/path_integral.h"

namespace holomorph {

MapOnMesh::MapOnMesh(const BoundaryBasis& basis, const Mesh& mesh)
    : basis_(basis),
      mesh_(mesh),
      tree_(mesh),
      values_(planar_coordinates<double>(polygon_cage(basis.polygon()), mesh.vertices, 0)),
      slopes_(planar_coordinates<double>(polygon_cage(basis.polygon()), mesh.vertices, 1)) {}

MapOnMesh::Values MapOnMesh::values(const LogMap& map) const {
  const VectorXc l = function(map.l), w = function(map.w);
  Values values;
  values.first = derivatives_of(map, l, w);
  const Derivatives second =
      second_derivatives_of(map, values.first, w, product(slopes_, map.l), product(slopes_, map.w));
  values.f = tree_.antiderivative(values.first.phi, second.phi) +
             tree_.antiderivative(values.first.psi, second.psi).conjugate();
  return values;
}

VectorXc MapOnMesh::integrated(const LogMap& map) const {
  std::vector<Line> lines;
  for (const auto [from, to] : tree_.edges())
    lines.push_back(
        {mesh_.vertices[static_cast<size_t>(from)], mesh_.vertices[static_cast<size_t>(to)]});
  const VectorXc increments = increments_along(basis_, map, lines);
  VectorXc f = VectorXc::Zero(static_cast<Index>(mesh_.vertices.size()));
  for (size_t e = 0; e < lines.size(); ++e) {
    const auto [from, to] = tree_.edges()[e];
    f[to] = f[from] + increments[static_cast<Index>(e)];
  }
  return f;
}

VectorXc MapOnMesh::phi(const VectorXc& l) const {
  const VectorXc fz = function(l).array().exp();
  return tree_.antiderivative(fz, product(slopes_, l).cwiseProduct(fz));
}

VectorXc MapOnMesh::antiderivative(const VectorXc& coefficients) const {
  return tree_.antiderivative(function(coefficients), product(slopes_, coefficients));
}

MatrixXc MapOnMesh::psi_rows(std::span<const Location> locations,
                             const MatrixXc& coefficients) const {
  MatrixXc rows(static_cast<Index>(locations.size()), coefficients.cols());
  for (Index j = 0; j < coefficients.cols(); ++j) {
    const VectorXc psi = antiderivative(coefficients.col(j));
    for (size_t i = 0; i < locations.size(); ++i)
      rows(static_cast<Index>(i), j) = locations[i].in(mesh_, as_span(psi));
  }
  return rows;
}

}  // namespace holomorph
