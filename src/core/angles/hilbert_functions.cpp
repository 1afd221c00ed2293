// Points are divided into groups of neighbors. Functions that are singular near a group are
// evaluated at its points. The sum of the others is analytic in a disk around the group, and is
// interpolated from equally spaced points on a circle.
#include "core/angles/hilbert_functions.h"

#include <algorithm>
#include <numeric>

#include "core/arithmetic.h"
#include "core/cauchy/cauchy_array.h"
#include "core/error.h"
#include "core/geometry/point_groups.h"
#include "core/geometry/polygon.h"
#include "core/parallel.h"
#include "core/solvers/dense.h"

namespace holomorph {
namespace {

constexpr size_t kGroupSize = 256;     ///< most points
constexpr size_t kGroupsTogether = 8;  ///< groups that one thread works on together
constexpr Index kCircleNodes = 24;     ///< on the circle around a group
/// Functions that are singular this many radii from a group's center or farther away are known to
/// 3^-kCircleNodes.
constexpr double kFarRadii = 3;

Complex logarithmic_slope(Complex at, Complex tip, Complex z) {
  return 1.0 / (z - at) - 1.0 / (z - tip);
}

Points nodes_of(const PointGroup& group) {
  Points nodes;
  for (Index k = 0; k < kCircleNodes; ++k)
    nodes.push_back(group.center + std::polar(group.radius, 2 * kPi * static_cast<double>(k) /
                                                                static_cast<double>(kCircleNodes)));
  return nodes;
}

/// The matrix that takes the values of a polynomial at a group's nodes to those at its points. With
/// q = (z - center) / (node - center), its entries are the means of 1, q, q^2, ...
MatrixXc interpolation(const PointGroup& group) {
  const Points nodes = nodes_of(group);
  MatrixXc matrix(static_cast<Index>(group.points.size()), kCircleNodes);
  for (Index k = 0; k < kCircleNodes; ++k)
    for (Index i = 0; i < matrix.rows(); ++i) {
      const Complex q = quotient(group.points[static_cast<size_t>(i)] - group.center,
                                 nodes[static_cast<size_t>(k)] - group.center);
      Complex sum = 1;
      for (Index power = 1; power < kCircleNodes; ++power) sum = 1.0 + times(q, sum);
      matrix(i, k) = sum / static_cast<double>(kCircleNodes);
    }
  return matrix;
}

}  // namespace

HilbertFunctions::HilbertFunctions(Cage boundary, std::vector<Vertex> vertices, Points centers,
                                   double size)
    : boundary_(std::move(boundary)),
      vertices_(std::move(vertices)),
      centers_(std::move(centers)),
      size_(size),
      count_(boundary_.control_count()) {
  for (const Vertex& vertex : vertices_) {
    columns_.push_back(count_);
    count_ += static_cast<Index>(vertex.powers.size()) + (vertex.jumps ? 1 : 0);
  }
  count_ += static_cast<Index>(centers_.size());
}

size_t HilbertFunctions::vertex_of(Index column) const {
  // Vertices without functions have the same column as the next one.
  return static_cast<size_t>(std::ranges::upper_bound(columns_, column) - columns_.begin() - 1);
}

Index HilbertFunctions::end_of(size_t vertex) const {
  return vertex + 1 < columns_.size() ? columns_[vertex + 1] : first_hole();
}

bool HilbertFunctions::is_logarithm(Index column) const {
  if (column < boundary_.control_count() || column >= first_hole()) return false;
  const size_t vertex = vertex_of(column);
  return vertices_[vertex].jumps && column == columns_[vertex];
}

HilbertFunctions::Singular HilbertFunctions::singular(const Vertex& vertex, Complex z) {
  const Complex ratio = quotient(z - vertex.at, z - vertex.tip);
  Singular at{{0.5 * std::log(std::norm(ratio)), std::atan2(ratio.imag(), ratio.real())}, {}};
  for (size_t k = 0; k < vertex.powers.size(); ++k) {
    const double power = vertex.powers[k];
    at.powers[k] = vertex.lower[k] >= 0
                       ? times(ratio, at.powers[static_cast<size_t>(vertex.lower[k])])
                       : std::polar(std::exp(power * at.log.real()), power * at.log.imag());
  }
  return at;
}

void HilbertFunctions::write_vertex(size_t vertex, std::span<const Complex> points, int order,
                                    Index column, MatrixXc& out) const {
  const Vertex& v = vertices_[vertex];
  const Index first_power = column + (v.jumps ? 1 : 0);
  if (!v.jumps && v.powers.empty()) return;
  for (size_t i = 0; i < points.size(); ++i) {
    const Index row = static_cast<Index>(i);
    const Singular at = singular(v, points[i]);
    const Complex slope = order == 0 ? 1.0 : logarithmic_slope(v.at, v.tip, points[i]);
    if (v.jumps) out(row, column) = order == 0 ? at.log : slope;
    for (size_t k = 0; k < v.powers.size(); ++k)
      out(row, first_power + static_cast<Index>(k)) =
          order == 0 ? at.powers[k] : v.powers[k] * slope * at.powers[k];
  }
}

void HilbertFunctions::write_holes(std::span<const Complex> points, int order, Index column,
                                   MatrixXc& out) const {
  for (const Complex& center : centers_) {
    for (size_t i = 0; i < points.size(); ++i) {
      const Complex z = points[i] - center;
      out(static_cast<Index>(i), column) = order == 0 ? std::log(z / size_) : inverse(z);
    }
    ++column;
  }
}

MatrixXc HilbertFunctions::values(std::span<const Complex> points, int order) const {
  std::vector<Index> all(static_cast<size_t>(count_));
  std::iota(all.begin(), all.end(), Index{0});
  return values_of(all, points, order);
}

MatrixXc HilbertFunctions::values_of(std::span<const Index> columns,
                                     std::span<const Complex> points, int order) const {
  const Index smooth = boundary_.control_count();
  MatrixXc values(static_cast<Index>(points.size()), static_cast<Index>(columns.size()));
  Index out = 0;
  size_t at = 0;
  if (!columns.empty() && columns.front() < smooth) {
    const PlanarMatrix<double> cauchy = planar_coordinates<double>(boundary_, points, order);
    for (; at < columns.size() && columns[at] < smooth; ++at, ++out) {
      values.col(out).real() = cauchy.re.col(columns[at]);
      values.col(out).imag() = cauchy.im.col(columns[at]);
    }
  }
  while (at < columns.size() && columns[at] < first_hole()) {
    const size_t vertex = vertex_of(columns[at]);
    const Index own = end_of(vertex) - columns_[vertex];
    write_vertex(vertex, points, order, out, values);
    out += own;
    at += static_cast<size_t>(own);
  }
  if (at < columns.size()) write_holes(points, order, out, values);
  return values;
}

std::vector<Index> HilbertFunctions::singular_within(Complex center, double distance) const {
  std::vector<Index> columns;
  Index column = 0;
  const auto add = [&](Index count, bool near) {
    for (Index end = column + count; column < end; ++column)
      if (near) columns.push_back(column);
  };
  std::vector<char> near_piece;
  for (Index e = 0; e < boundary_.size(); ++e) {
    const Points controls = boundary_.controls(e);
    double bulge = 0;
    for (const Complex& z : controls)
      bulge = std::max(bulge, nearest_on_segment(controls.front(), controls.back(), z).distance);
    near_piece.push_back(nearest_on_segment(controls.front(), controls.back(), center).distance <
                         distance + bulge);
  }
  for (Index e = 0; e < boundary_.size(); ++e) {
    const bool near = near_piece[static_cast<size_t>(e)] != 0;
    add(1, near || near_piece[static_cast<size_t>(boundary_.before(e))] != 0);
    add(boundary_.degree(e) - 1, near);
  }
  for (size_t j = 0; j < vertices_.size(); ++j)
    add(end_of(j) - column,
        nearest_on_segment(vertices_[j].at, vertices_[j].tip, center).distance < distance);
  add(static_cast<Index>(centers_.size()), true);  // their branch cuts cross the cage
  return columns;
}

void HilbertFunctions::for_each_group(std::span<const Complex> points, const MatrixXc& coefficients,
                                      int order, const VisitGroup& visit) const {
  const std::vector<PointGroup> groups = point_groups(points, kGroupSize);
  parallel_for(
      static_cast<int>((groups.size() + kGroupsTogether - 1) / kGroupsTogether), [&](int batch) {
        const size_t first = static_cast<size_t>(batch) * kGroupsTogether;
        const auto some =
            std::span(groups).subspan(first, std::min(kGroupsTogether, groups.size() - first));
        visit_batch(some, coefficients, order, visit);
      });
}

void HilbertFunctions::visit_batch(std::span<const PointGroup> groups, const MatrixXc& coefficients,
                                   int order, const VisitGroup& visit) const {
  struct Far {
    const PointGroup* group;
    std::vector<Index> near;
  };
  std::vector<Far> interpolated;
  Points nodes;
  for (const PointGroup& group : groups) {
    std::vector<Index> near = singular_within(group.center, kFarRadii * group.radius);
    const Index count = static_cast<Index>(group.points.size()),
                each = static_cast<Index>(near.size()) + kCircleNodes;
    if (group.radius == 0 || kCircleNodes * count_ + count * each > count * count_) {
      MatrixXc sums = matrix_product(values(group.points, order), coefficients);
      visit(group, sums);
      continue;
    }
    interpolated.push_back({&group, std::move(near)});
    std::ranges::copy(nodes_of(group), std::back_inserter(nodes));
  }
  if (interpolated.empty()) return;
  MatrixXc far = values(nodes, order);
  Index first = 0;
  for (const auto& [group, near] : interpolated) {
    for (const Index column : near) far.col(column).segment(first, kCircleNodes).setZero();
    first += kCircleNodes;
  }
  const MatrixXc at_nodes = matrix_product(far, coefficients);
  first = 0;
  for (const auto& [group, near] : interpolated) {
    MatrixXc sums = matrix_product(interpolation(*group), at_nodes.middleRows(first, kCircleNodes));
    if (!near.empty())
      sums += matrix_product(values_of(near, group->points, order), coefficients(near, kAll));
    visit(*group, sums);
    first += kCircleNodes;
  }
}

}  // namespace holomorph
