// Each matrix is multiplied with l and nu at once, because reading the matrices takes most of the
// time.
#include "core/isometric/mesh_display.h"

#include "core/arithmetic.h"
#include "core/isometric/energy.h"

namespace holomorph {

MeshDisplay::MeshDisplay(const BoundaryBasis& basis, const Mesh& mesh)
    : tree_(mesh),
      values_(planar_coordinates<float>(polygon_cage(basis.polygon()), mesh.vertices, 0)),
      slopes_(planar_coordinates<float>(polygon_cage(basis.polygon()), mesh.vertices, 1)) {}

MeshDisplay::Values MeshDisplay::values(const LogMap& map) const {
  const Index n = map.l.size(), count = values_.rows();
  PlanarMatrix<float> factors(n, 2), at(count, 2), by(count, 2);
  // Rows sum to one only up to rounding. A constant is added in double precision.
  const Complex l0 = map.l.mean(), w0 = map.w.mean();
  factors.re.col(0) = (map.l.array() - l0).real().cast<float>();
  factors.im.col(0) = (map.l.array() - l0).imag().cast<float>();
  factors.re.col(1) = (map.w.array() - w0).real().cast<float>();
  factors.im.col(1) = (map.w.array() - w0).imag().cast<float>();
  multiply(values_, factors, at);
  multiply(slopes_, factors, by);
  Values result;
  result.first = {VectorXc(count), VectorXc(count)};
  VectorXc grown(count), phi2(count), psi2(count);
  for (Index i = 0; i < count; ++i) {
    const Complex l = l0 + Complex(at(i, 0)), w = w0 + Complex(at(i, 1)), l1(by(i, 0)),
                  w1(by(i, 1));
    grown[i] = exp_minus_one(l);
    const Complex phi = 1.0 + grown[i];
    result.first.phi[i] = phi;
    result.first.psi[i] = times(w, phi);
    phi2[i] = times(l1, phi);
    psi2[i] = times(w1 + times(w, l1), phi);
  }
  result.moved =
      tree_.antiderivative(grown, phi2) + tree_.antiderivative(result.first.psi, psi2).conjugate();
  return result;
}

}  // namespace holomorph
