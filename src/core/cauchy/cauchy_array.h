// The array path: Cauchy coordinates of many points in one call, and products with them.
//
// The values agree with those of cauchy.h to 1e-14 for degree 1 and to 1e-13 for higher degrees.
// Away from a segment, the coordinates are a power series in 1 / W^2, where W = q - s is twice the
// offset from the midpoint in edge lengths. Near the segment, they require one logarithm. Both
// formulas run without branches over blocks of points, and the compiler vectorizes them. The series
// needs fewer terms than a quadrature rule of the same accuracy needs nodes.
#pragma once

#include <span>

#include "core/geometry/cage.h"

namespace holomorph {

/// A complex matrix, stored as two real matrices in column-major order. The compiler can vectorize
/// loops over this storage.
template <class T>
struct PlanarMatrix {
  using Real = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  Real re, im;

  PlanarMatrix() = default;
  PlanarMatrix(Index rows, Index cols) : re(rows, cols), im(rows, cols) {}
  void resize(Index rows, Index cols) {
    re.resize(rows, cols);
    im.resize(rows, cols);
  }
  Index rows() const { return re.rows(); }
  Index cols() const { return re.cols(); }
  std::complex<T> operator()(Index i, Index j) const { return {re(i, j), im(i, j)}; }
};

/// The same matrix with complex entries.
template <class T>
MatrixXc as_complex(const PlanarMatrix<T>& planar) {
  MatrixXc c(planar.rows(), planar.cols());
  c.real() = planar.re.template cast<double>();
  c.imag() = planar.im.template cast<double>();
  return c;
}

/// The machine code to run: `automatic` selects the widest of AVX-512, AVX2 and portable that the
/// processor supports.
enum class Kernel { automatic, portable, avx2 };
/// Whether this processor can run Kernel::avx2.
bool has_avx2();

/// Cauchy coordinates (order 0 or 1) of a cage's control points: points x control points.
/// Orientation, boundary limits and identities are as for cauchy_coordinates, with one exception:
/// derivatives at a vertex are evaluated inside the cage, at a distance of 1e-12 of an edge. This
/// gives the limit if it is finite. Bases of degree above 4 use the code in cauchy.h. Rows of order
/// 0 sum to one only up to 1e-11. If the control points are far from the origin, compute products
/// relative to their center. Points in any order are fast; scattered ones are sorted first.
/// Cost with AVX2: 3 ns per point and edge of degree 1, 8 ns for degree 3; 0.4 us per point and
/// curved cubic segment, most of it for the roots.
template <class T>
PlanarMatrix<T> planar_coordinates(const Cage& cage, std::span<const Complex> points, int order = 0,
                                   Kernel kernel = Kernel::automatic);

/// Writes the coordinates to `out` and reuses its storage. Allocating new memory costs as much as
/// computing the coordinates.
template <class T>
void planar_coordinates(const Cage& cage, std::span<const Complex> points, int order, Kernel kernel,
                        PlanarMatrix<T>& out);

/// out = matrix * factors. `out` must be matrix.rows() x factors.cols(), and factors.rows() must be
/// matrix.cols(). Cost: 8 flops per entry and factor column, in one pass over the matrix.
template <class T>
void multiply(const PlanarMatrix<T>& matrix, const PlanarMatrix<T>& factors, PlanarMatrix<T>& out,
              Kernel kernel = Kernel::automatic);

/// matrix * factors for one column of factors, computed in the precision of the matrix.
template <class T>
VectorXc product(const PlanarMatrix<T>& matrix, const VectorXc& factors);

}  // namespace holomorph
