// The kernels fill blocks of points, segment by segment. Points on the boundary use the stable
// formula.
#include "core/cauchy/cauchy_array.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/cauchy/cauchy_kernel.h"
#include "core/cauchy/cauchy_rows.h"
#include "core/error.h"
#include "core/geometry/nearby_order.h"
#include "core/geometry/orientation.h"

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

/// Fills the rows of one block of consecutive points, segment by segment.
template <class T>
class BlockFiller {
 public:
  BlockFiller(const Cage& cage, double farthest, int order, const kernel::Table& table,
              PlanarMatrix<T>& out)
      : cage_(cage), order_(order), table_(table), out_(out) {
    for (Index e = 0; e < cage.size(); ++e) {
      offsets_.push_back(cage.control_offset(e));
      segments_.emplace_back(cage.controls(e));
      roots_.emplace_back(segments_.back().degree());
      const Complex a = cage.vertex(e), b = cage.end_vertex(e);
      const Complex unit = std::conj(b - a) / std::norm(b - a);
      const double rounding = 16 * std::numeric_limits<double>::epsilon() *
                              (std::abs(a) + std::abs(b) + farthest) / std::abs(b - a);
      edges_.push_back(
          {a.real(), a.imag(), b.real(), b.imag(), unit.real(), unit.imag(), rounding});
    }
  }

  void fill(std::span<const Complex> points, Index first) {
    const Index count = std::min<Index>(kernel::kBlock, static_cast<Index>(points.size()) - first);
    here_ = points.subspan(first, count);
    set_up_points();
    needs_patch_.fill(false);
    // The column of a vertex is the last moment of the segment before it plus the first moment of
    // the segment after it.
    const Loops loops = cage_.loops();
    for (Index l = 0; l < loops.count(); ++l) {
      Index last = loops.end(l) - 1;
      moments_of(last, moments_[(loops.first(l) + 1) % 2]);
      for (Index e = loops.first(l); e < loops.end(l); last = e++) {
        kernel::Moments& own = moments_[e % 2];
        const kernel::Moments& before = moments_[(e + 1) % 2];
        moments_of(e, own);
        write(own, 0, &before, cage_.degree(last), first, offsets_[e]);
        for (int m = 1; m < cage_.degree(e); ++m) write(own, m, nullptr, 0, first, offsets_[e] + m);
      }
    }
    for (Index i = 0; i < count; ++i)
      if (needs_patch_[i]) patch_row(here_[i], first + i);
  }

 private:
  void set_up_points() {
    const Complex center = box_of(here_).center();
    points_.center_x = center.real();
    points_.center_y = center.imag();
    points_.radius = 0;
    for (size_t i = 0; i < kernel::kBlock; ++i) {
      const Complex z = here_[std::min(i, here_.size() - 1)];
      points_.x[i] = z.real();
      points_.y[i] = z.imag();
      points_.radius = std::max(points_.radius, std::norm(z - center));
    }
    points_.radius = std::sqrt(points_.radius);
  }

  void write(const kernel::Moments& own, int m, const kernel::Moments* before, int last,
             Index first, Index column) {
    join_of(table_, T{})(own.re[m], own.im[m], before ? before->re[last] : nullptr,
                         before ? before->im[last] : nullptr, static_cast<long>(here_.size()),
                         out_.re.col(column).data() + first, out_.im.col(column).data() + first);
  }

  void moments_of(Index e, kernel::Moments& moments) {
    if (!segments_[e].is_straight()) return curved_moments_of(e, moments);
    if (!table_.edge_moments(edges_[e], points_, cage_.degree(e), order_, moments)) return;
    for (size_t i = 0; i < here_.size(); ++i)
      if (moments.on_edge[i] != 0) needs_patch_[i] = true;
  }

  /// Each root of a curve plays the role of s for a straight edge. Points with a root near the
  /// segment, or with two nearly equal roots, take the exact path.
  void curved_moments_of(Index e, kernel::Moments& moments) {
    const SegmentPolynomial& segment = segments_[e];
    std::vector<Root>& roots = roots_[e];  // the roots of the previous point, which is nearby
    std::array<bool, kernel::kBlock> careful{};
    all_roots_.resize(roots.size());
    for (size_t i = 0; i < kernel::kBlock; ++i) {
      const Complex z(points_.x[i], points_.y[i]);
      std::vector<Root>& found = fresh_;
      found.resize(roots.size());
      segment.roots(z, found, warm_[e] ? std::span<const Root>(roots) : std::span<const Root>());
      warm_[e] = true;
      roots = found;
      careful[i] = needs_care(found, std::max(1e-6, 4 * edges_[static_cast<size_t>(e)].rounding));
      for (size_t r = 0; r < roots.size(); ++r) {
        const Complex factor = order_ == 0 || careful[i] ? 1.0 : 1.0 / segment.derivative(roots[r]);
        kernel::Roots& block = all_roots_[r];
        // For points that take the exact path, any root off the segment serves as a placeholder.
        const Complex s = careful[i] ? Complex(0.5, 1) : roots[r].s,
                      q = careful[i] ? 1.0 - s : roots[r].q;
        block.s_re[i] = s.real(), block.s_im[i] = s.imag();
        block.q_re[i] = q.real(), block.q_im[i] = q.imag();
        block.factor_re[i] = factor.real(), block.factor_im[i] = factor.imag();
      }
    }
    for (int m = 0; m <= cage_.degree(e); ++m)
      for (int i = 0; i < kernel::kBlock; ++i) moments.re[m][i] = moments.im[m][i] = 0;
    for (const kernel::Roots& block : all_roots_)
      table_.root_moments(block, cage_.degree(e), order_, moments);
    for (size_t i = 0; i < here_.size(); ++i)
      if (careful[i]) set_exactly(e, i, moments);
  }

  /// Whether a root is near an end of the segment or within `rounding` segment lengths of the
  /// segment.
  static bool is_near(const Root& root, double rounding) {
    constexpr double kEnd = 1e-4;
    return (std::abs(root.s.imag()) < rounding && root.s.real() > -rounding &&
            root.q.real() > -rounding) ||
           std::norm(root.s) < kEnd * kEnd || std::norm(root.q) < kEnd * kEnd;
  }

  /// Whether a root is near the segment or nearly double.
  static bool needs_care(std::span<const Root> roots, double rounding) {
    constexpr double kCloseRoots = 0.05;
    for (size_t r = 0; r < roots.size(); ++r) {
      if (is_near(roots[r], rounding)) return true;
      for (size_t other = 0; other < r; ++other)
        if (std::norm(roots[r].s - roots[other].s) < kCloseRoots * kCloseRoots) return true;
    }
    return false;
  }

  void set_exactly(Index e, size_t i, kernel::Moments& moments) {
    needs_patch_[i] = true;
    const VectorXc values = segment_coordinates(segments_[e], cage_.degree(e), here_[i], order_);
    for (int m = 0; m <= cage_.degree(e); ++m) {
      moments.re[m][i] = values[m].real();
      moments.im[m][i] = values[m].imag();
    }
  }

  /// Corrects the row of a point that is on the boundary or next to a vertex, where all segments
  /// must be evaluated at the same position.
  void patch_row(Complex z, Index row) {
    if (!rows_) rows_.emplace(cage_, order_, CauchyRows::AtVertices::from_inside);
    const auto patch = rows_->patch(z);
    if (!patch) return;
    for (Index k = 0; k < patch->values.size(); ++k) {
      const Index column = patch->columns[static_cast<size_t>(k)];
      out_.re(row, column) = static_cast<T>(patch->values[k].real());
      out_.im(row, column) = static_cast<T>(patch->values[k].imag());
    }
  }

  const Cage& cage_;
  std::optional<CauchyRows> rows_;  ///< created on first use
  int order_;
  const kernel::Table& table_;
  PlanarMatrix<T>& out_;
  std::vector<Index> offsets_;
  std::vector<SegmentPolynomial> segments_;
  std::vector<kernel::Edge> edges_;
  std::vector<std::vector<Root>> roots_;  ///< for each segment, the roots of the last point
  std::vector<char> warm_ = std::vector<char>(static_cast<size_t>(cage_.size()), 0);
  std::vector<Root> fresh_;
  std::vector<kernel::Roots> all_roots_;
  std::span<const Complex> here_;
  kernel::Moments moments_[2]{};
  kernel::Block points_{};
  std::array<bool, kernel::kBlock> needs_patch_{};
};

/// The exact path, for degrees that the kernels do not integrate.
template <class T>
void fill_exactly(const Cage& cage, std::span<const Complex> points, int order,
                  PlanarMatrix<T>& out) {
  const CauchyRows rows(cage, order, CauchyRows::AtVertices::from_inside);
  out.resize(static_cast<Index>(points.size()), cage.control_count());
  for (Index i = 0; i < out.rows(); ++i) {
    const VectorXc row = rows.row(points[static_cast<size_t>(i)]);
    out.re.row(i) = row.real().template cast<T>();
    out.im.row(i) = row.imag().template cast<T>();
  }
}

/// Fills the rows in an order in which blocks contain neighbors, so that most blocks are on one
/// side of the choice between the two formulas for each edge.
template <class T>
void fill_in_nearby_order(const Cage& cage, double farthest, std::span<const Complex> points,
                          int order, const kernel::Table& table, PlanarMatrix<T>& out) {
  constexpr Index kChunk = 2048;  // rows whose columns stay in the cache until they are copied
  const std::vector<Index> rows = nearby_order(points);
  PlanarMatrix<T> chunk(std::min(kChunk, out.rows()), out.cols());
  BlockFiller<T> filler(cage, farthest, order, table, chunk);
  Points near;
  for (Index first = 0; first < out.rows(); first += kChunk) {
    const std::span<const Index> here = std::span(rows).subspan(
        static_cast<size_t>(first), static_cast<size_t>(std::min(kChunk, out.rows() - first)));
    near.clear();
    for (const Index row : here) near.push_back(points[static_cast<size_t>(row)]);
    for (Index start = 0; start < static_cast<Index>(near.size()); start += kernel::kBlock)
      filler.fill(near, start);
    for (Index c = 0; c < out.cols(); ++c)
      for (size_t i = 0; i < here.size(); ++i) {
        out.re(here[i], c) = chunk.re(static_cast<Index>(i), c);
        out.im(here[i], c) = chunk.im(static_cast<Index>(i), c);
      }
  }
}

}  // namespace

bool has_avx2() {
#ifdef HOLOMORPH_HAS_AVX2
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

template <class T>
PlanarMatrix<T> planar_coordinates(const Cage& cage, std::span<const Complex> points, int order,
                                   Kernel choice) {
  PlanarMatrix<T> result;
  planar_coordinates(cage, points, order, choice, result);
  return result;
}

template <class T>
void planar_coordinates(const Cage& cage, std::span<const Complex> points, int order, Kernel choice,
                        PlanarMatrix<T>& out) {
  check(order == 0 || order == 1, "planar_coordinates: order 0 or 1");
  if (const Orientation orientation(cage); !orientation.is_oriented()) {
    PlanarMatrix<T> turned;
    planar_coordinates<T>(orientation.turned(cage), points, order, choice, turned);
    out.resize(turned.rows(), turned.cols());
    const std::vector<Index> column = orientation.columns(cage);
    for (Index c = 0; c < out.cols(); ++c) {
      out.re.col(c) = turned.re.col(column[c]);
      out.im.col(c) = turned.im.col(column[c]);
    }
    return;
  }
  for (Index e = 0; e < cage.size(); ++e)
    if (cage.degree(e) > kernel::kMaxDegree) return fill_exactly(cage, points, order, out);
  out.resize(static_cast<Index>(points.size()), cage.control_count());
  double farthest = 0;
  for (const Complex& z : points) farthest = std::max(farthest, std::abs(z));
  if (are_scattered(points))
    return fill_in_nearby_order(cage, farthest, points, order, table_of(choice), out);
  BlockFiller<T> filler(cage, farthest, order, table_of(choice), out);
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
  constexpr Index kRows = 512;  // a block of kRows rows stays in the cache for all columns
  for (Index row = 0; row < matrix.rows(); row += kRows) {
    const Index count = std::min(kRows, matrix.rows() - row);
    for (Index column = 0; column < factors.cols(); ++column)
      product(matrix.re.data() + row, matrix.im.data() + row, matrix.rows(), count, matrix.cols(),
              factors.re.col(column).data(), factors.im.col(column).data(),
              out.re.col(column).data() + row, out.im.col(column).data() + row);
  }
}

template <class T>
VectorXc product(const PlanarMatrix<T>& matrix, const VectorXc& factors) {
  if (matrix.rows() == 0) return {};
  PlanarMatrix<T> column(factors.size(), 1), sum(matrix.rows(), 1);
  column.re = factors.real().template cast<T>();
  column.im = factors.imag().template cast<T>();
  multiply(matrix, column, sum);
  VectorXc result(matrix.rows());
  result.real() = sum.re.template cast<double>();
  result.imag() = sum.im.template cast<double>();
  return result;
}

template VectorXc product<float>(const PlanarMatrix<float>&, const VectorXc&);
template VectorXc product<double>(const PlanarMatrix<double>&, const VectorXc&);
template PlanarMatrix<float> planar_coordinates<float>(const Cage&, std::span<const Complex>, int,
                                                       Kernel);
template PlanarMatrix<double> planar_coordinates<double>(const Cage&, std::span<const Complex>, int,
                                                         Kernel);
template void planar_coordinates<float>(const Cage&, std::span<const Complex>, int, Kernel,
                                        PlanarMatrix<float>&);
template void planar_coordinates<double>(const Cage&, std::span<const Complex>, int, Kernel,
                                         PlanarMatrix<double>&);
template void multiply<float>(const PlanarMatrix<float>&, const PlanarMatrix<float>&,
                              PlanarMatrix<float>&, Kernel);
template void multiply<double>(const PlanarMatrix<double>&, const PlanarMatrix<double>&,
                               PlanarMatrix<double>&, Kernel);

}  // namespace holomorph
