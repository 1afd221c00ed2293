// Blocks of points times edges: the series for the block, the stable formula for what is near.
#include "core/cauchy_array.h"

#include "core/cauchy.h"
#include "core/cauchy_kernel.h"
#include "core/error.h"

namespace holomorph {
namespace {

const kernel::Table& table_of(Kernel choice) {
#ifdef HOLOMORPH_HAS_AVX2
  if (choice == Kernel::avx2 || (choice == Kernel::automatic && has_avx2())) return kernel::kAvx2;
#endif
  return kernel::kPortable;
}

const auto product_of(const kernel::Table& table, float) { return table.product_float; }
const auto product_of(const kernel::Table& table, double) { return table.product_double; }

/// One block of consecutive points and the columns that it fills.
template <class T>
class BlockFiller {
 public:
  BlockFiller(std::span<const Complex> polygon, int order, const kernel::Table& table,
              PlanarMatrix<T>& out)
      : polygon_(polygon), order_(order), table_(table), out_(out), sums_re_(kernel::kBlock, polygon.size()),
        sums_im_(kernel::kBlock, polygon.size()) {
    for (size_t e = 0; e < polygon.size(); ++e) {
      const Complex a = polygon[e], side = polygon[(e + 1) % polygon.size()] - a;
      const Complex unit = std::conj(side) / std::norm(side);
      edges_.push_back({a.real(), a.imag(), unit.real(), unit.imag()});
    }
  }

  void fill(std::span<const Complex> points, Index first) {
    const Index count = std::min<Index>(kernel::kBlock, static_cast<Index>(points.size()) - first);
    for (Index i = 0; i < kernel::kBlock; ++i) {
      const Complex z = points[first + std::min(i, count - 1)];
      x_[i] = z.real();
      y_[i] = z.imag();
    }
    sums_re_.setZero();
    sums_im_.setZero();
    const Index n = static_cast<Index>(polygon_.size());
    for (Index e = 0; e < n; ++e) {
      table_.edge_series(edges_[e], x_, y_, order_, halves_);
      for (Index i = 0; i < count; ++i)
        if (halves_.w2[i] < kernel::kNear2) set_near(points[first + i], e, i);
      add(halves_.start_re, halves_.start_im, e);
      add(halves_.end_re, halves_.end_im, e + 1 == n ? 0 : e + 1);
    }
    for (Index i = 0; i < count; ++i) replace_vertex_row(points[first + i], i);
    out_.re.middleRows(first, count) = sums_re_.topRows(count).template cast<T>();
    out_.im.middleRows(first, count) = sums_im_.topRows(count).template cast<T>();
  }

 private:
  using Sums = Eigen::Matrix<double, kernel::kBlock, Eigen::Dynamic>;

  void add(const double* re, const double* im, Index column) {
    using Block = Eigen::Map<const Eigen::Matrix<double, kernel::kBlock, 1>>;
    sums_re_.col(column) += Block(re);
    sums_im_.col(column) += Block(im);
  }

  void set_near(Complex z, Index e, Index i) {
    const Complex a = polygon_[e], b = polygon_[(e + 1) % polygon_.size()];
    if (z == a || z == b) {  // replace_vertex_row has the limit
      halves_.start_re[i] = halves_.start_im[i] = halves_.end_re[i] = halves_.end_im[i] = 0;
      return;
    }
    const std::array<Complex, 2> values = linear_edge_coordinates(a, b, z, order_);
    halves_.start_re[i] = values[0].real();
    halves_.start_im[i] = values[0].imag();
    halves_.end_re[i] = values[1].real();
    halves_.end_im[i] = values[1].imag();
  }

  void replace_vertex_row(Complex z, Index i) {
    for (const Complex& vertex : polygon_)
      if (vertex == z) {
        const MatrixXc row = cauchy_coordinates(polygon_cage(polygon_), std::span(&z, 1), order_);
        sums_re_.row(i) = row.real();
        sums_im_.row(i) = row.imag();
        return;
      }
  }

  std::span<const Complex> polygon_;
  int order_;
  const kernel::Table& table_;
  PlanarMatrix<T>& out_;
  std::vector<kernel::Edge> edges_;
  kernel::Halves halves_{};
  double x_[kernel::kBlock], y_[kernel::kBlock];
  Sums sums_re_, sums_im_;
};

}  // namespace

bool has_avx2() {
#ifdef HOLOMORPH_HAS_AVX2
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

template <class T>
PlanarMatrix<T> polygon_coordinates(std::span<const Complex> polygon, std::span<const Complex> points,
                                    int order, Kernel choice) {
  check(order == 0 || order == 1, "polygon_coordinates: order 0 or 1");
  if (signed_area(polygon) < 0) {  // the same first vertex, the others backwards
    Points turned(polygon.begin(), polygon.end());
    std::reverse(turned.begin() + 1, turned.end());
    PlanarMatrix<T> result = polygon_coordinates<T>(turned, points, order, choice);
    const Index others = result.cols() - 1;
    result.re.rightCols(others) = result.re.rightCols(others).rowwise().reverse().eval();
    result.im.rightCols(others) = result.im.rightCols(others).rowwise().reverse().eval();
    return result;
  }
  PlanarMatrix<T> result(static_cast<Index>(points.size()), static_cast<Index>(polygon.size()));
  BlockFiller<T> filler(polygon, order, table_of(choice), result);
  for (Index first = 0; first < result.rows(); first += kernel::kBlock) filler.fill(points, first);
  return result;
}

template <class T>
void multiply(const PlanarMatrix<T>& matrix, const PlanarMatrix<T>& factors, PlanarMatrix<T>& out,
              Kernel choice) {
  check(matrix.cols() == factors.rows() && out.rows() == matrix.rows() && out.cols() == factors.cols(),
        "multiply: shapes agree");
  const auto product = product_of(table_of(choice), T{});
  out.re.setZero();
  out.im.setZero();
  constexpr Index kRows = 512;  // a block of the matrix stays in the cache for all factor columns
  for (Index row = 0; row < matrix.rows(); row += kRows) {
    const Index count = std::min(kRows, matrix.rows() - row);
    for (Index column = 0; column < factors.cols(); ++column)
      product(matrix.re.data() + row, matrix.im.data() + row, matrix.rows(), count, matrix.cols(),
              factors.re.col(column).data(), factors.im.col(column).data(),
              out.re.col(column).data() + row, out.im.col(column).data() + row);
  }
}

template PlanarMatrix<float> polygon_coordinates<float>(std::span<const Complex>,
                                                        std::span<const Complex>, int, Kernel);
template PlanarMatrix<double> polygon_coordinates<double>(std::span<const Complex>,
                                                          std::span<const Complex>, int, Kernel);
template void multiply<float>(const PlanarMatrix<float>&, const PlanarMatrix<float>&,
                              PlanarMatrix<float>&, Kernel);
template void multiply<double>(const PlanarMatrix<double>&, const PlanarMatrix<double>&,
                               PlanarMatrix<double>&, Kernel);

}  // namespace holomorph
