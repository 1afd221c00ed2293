// Blocks of points times edges by the kernels; the stable formula for points on the edge itself.
#include "core/cauchy_array.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/cauchy.h"
#include "core/cauchy_kernel.h"
#include "core/error.h"

namespace holomorph {
namespace {

const kernel::Table& table_of(Kernel choice) {
#ifdef HOLOMORPH_HAS_AVX2
  static const bool avx512 = __builtin_cpu_supports("avx512f") &&
                             __builtin_cpu_supports("avx512dq") &&
                             __builtin_cpu_supports("avx512vl");
  if (choice == Kernel::automatic && avx512 && has_avx2()) return kernel::kAvx512;
  if (choice == Kernel::avx2 || (choice == Kernel::automatic && has_avx2())) return kernel::kAvx2;
#endif
  return kernel::kPortable;
}

auto join_of(const kernel::Table& table, float) {
  return table.join_float;
}
auto join_of(const kernel::Table& table, double) {
  return table.join_double;
}
auto product_of(const kernel::Table& table, float) {
  return table.product_float;
}
auto product_of(const kernel::Table& table, double) {
  return table.product_double;
}

/// One block of consecutive points and the columns that it fills.
template <class T>
class BlockFiller {
 public:
  BlockFiller(std::span<const Complex> polygon, double farthest, int order,
              const kernel::Table& table, PlanarMatrix<T>& out)
      : polygon_(polygon), order_(order), table_(table), out_(out) {
    for (size_t e = 0; e < polygon.size(); ++e) {
      const Complex a = polygon[e], side = polygon[(e + 1) % polygon.size()] - a;
      const Complex unit = std::conj(side) / std::norm(side);
      const double rounding = 16 * std::numeric_limits<double>::epsilon() *
                              (std::abs(a) + std::abs(a + side) + farthest) / std::abs(side);
      const Complex b = polygon[(e + 1) % polygon.size()];
      edges_.push_back(
          {a.real(), a.imag(), b.real(), b.imag(), unit.real(), unit.imag(), rounding});
    }
  }

  void fill(std::span<const Complex> points, Index first) {
    const Index count = std::min<Index>(kernel::kBlock, static_cast<Index>(points.size()) - first);
    const auto here = points.subspan(first, count);
    const Complex center = box_of(here).center();
    points_.center_x = center.real();
    points_.center_y = center.imag();
    points_.radius = 0;
    for (Index i = 0; i < kernel::kBlock; ++i) {
      const Complex z = here[std::min(i, count - 1)];
      points_.x[i] = z.real();
      points_.y[i] = z.imag();
      points_.radius = std::max(points_.radius, std::norm(z - center));
    }
    points_.radius = std::sqrt(points_.radius);
    at_vertex_.fill(false);
    // A vertex's column is the end half of the edge before it and the start half of the edge after.
    const Index n = static_cast<Index>(polygon_.size());
    halves_of_edge(n - 1, here, halves_[1]);
    for (Index e = 0; e < n; ++e) {
      kernel::Halves& current = halves_[e % 2];
      const kernel::Halves& before = halves_[(e + 1) % 2];
      halves_of_edge(e, here, current);
      join_of(table_, T{})(before, current, count, out_.re.col(e).data() + first,
                           out_.im.col(e).data() + first);
    }
    for (Index i = 0; i < count; ++i)
      if (at_vertex_[i]) finish_vertex_row(here[i], first + i);
  }

 private:
  void halves_of_edge(Index e, std::span<const Complex> points, kernel::Halves& halves) {
    if (!table_.edge_series(edges_[e], points_, order_, halves)) return;
    for (size_t i = 0; i < points.size(); ++i)
      if (halves.on_edge[i] != 0) set_on_edge(points[i], e, i, halves);
  }

  void set_on_edge(Complex z, Index e, size_t i, kernel::Halves& halves) {
    const Complex a = polygon_[e], b = polygon_[(e + 1) % polygon_.size()];
    VectorXc values = VectorXc::Zero(2);
    if (z == a || z == b)
      at_vertex_[i] = true;  // finish_vertex_row adds the limit of both its edges
    else
      values = edge_coordinates(a, b, 1, z, order_);
    halves.start_re[i] = values[0].real();
    halves.start_im[i] = values[0].imag();
    halves.end_re[i] = values[1].real();
    halves.end_im[i] = values[1].imag();
  }

  /// The limit at a vertex: its two edges, left out so far, contribute to three columns.
  void finish_vertex_row(Complex z, Index row) {
    const Index n = static_cast<Index>(polygon_.size());
    const Index vertex = std::find(polygon_.begin(), polygon_.end(), z) - polygon_.begin();
    if (order_ > 0) {
      out_.re.row(row).setConstant(std::numeric_limits<T>::quiet_NaN());
      out_.im.row(row).setConstant(std::numeric_limits<T>::quiet_NaN());
      return;
    }
    const Index before = (vertex + n - 1) % n, after = (vertex + 1) % n;
    const Complex own = vertex_limit(polygon_[before], z, polygon_[after]);
    out_.re(row, vertex) += static_cast<T>(own.real());
    out_.im(row, vertex) += static_cast<T>(own.imag());
    out_.im(row, before) += static_cast<T>(1 / (2 * kPi));
    out_.im(row, after) -= static_cast<T>(1 / (2 * kPi));
  }

  std::span<const Complex> polygon_;
  int order_;
  const kernel::Table& table_;
  PlanarMatrix<T>& out_;
  std::vector<kernel::Edge> edges_;
  kernel::Halves halves_[2]{};
  kernel::Block points_{};
  std::array<bool, kernel::kBlock> at_vertex_{};
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
PlanarMatrix<T> polygon_coordinates(std::span<const Complex> polygon,
                                    std::span<const Complex> points, int order, Kernel choice) {
  PlanarMatrix<T> result;
  polygon_coordinates(polygon, points, order, choice, result);
  return result;
}

template <class T>
void polygon_coordinates(std::span<const Complex> polygon, std::span<const Complex> points,
                         int order, Kernel choice, PlanarMatrix<T>& out) {
  check(order == 0 || order == 1, "polygon_coordinates: order 0 or 1");
  if (signed_area(polygon) < 0) {  // the same first vertex, the others backwards
    Points turned(polygon.begin(), polygon.end());
    std::reverse(turned.begin() + 1, turned.end());
    polygon_coordinates<T>(turned, points, order, choice, out);
    const Index others = out.cols() - 1;
    out.re.rightCols(others) = out.re.rightCols(others).rowwise().reverse().eval();
    out.im.rightCols(others) = out.im.rightCols(others).rowwise().reverse().eval();
    return;
  }
  out.resize(static_cast<Index>(points.size()), static_cast<Index>(polygon.size()));
  double farthest = 0;
  for (const Complex& z : points) farthest = std::max(farthest, std::abs(z));
  BlockFiller<T> filler(polygon, farthest, order, table_of(choice), out);
  for (Index first = 0; first < out.rows(); first += kernel::kBlock) filler.fill(points, first);
}

template <class T>
void multiply(const PlanarMatrix<T>& matrix, const PlanarMatrix<T>& factors, PlanarMatrix<T>& out,
              Kernel choice) {
  check(matrix.cols() == factors.rows() && out.rows() == matrix.rows() &&
            out.cols() == factors.cols(),
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
template void polygon_coordinates<float>(std::span<const Complex>, std::span<const Complex>, int,
                                         Kernel, PlanarMatrix<float>&);
template void polygon_coordinates<double>(std::span<const Complex>, std::span<const Complex>, int,
                                          Kernel, PlanarMatrix<double>&);
template void multiply<float>(const PlanarMatrix<float>&, const PlanarMatrix<float>&,
                              PlanarMatrix<float>&, Kernel);
template void multiply<double>(const PlanarMatrix<double>&, const PlanarMatrix<double>&,
                               PlanarMatrix<double>&, Kernel);

}  // namespace holomorph
