// Integrates along a tree of mesh edges by the trapezoidal rule, with a correction from second
// derivatives.
#include "core/bounded/map_on_mesh.h"

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
