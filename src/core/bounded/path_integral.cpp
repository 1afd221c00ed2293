// Points are evaluated a few thousand at a time, because the coordinates of all points would need
// too much memory.
#include "core/bounded/path_integral.h"

#include <algorithm>

#include "core/cauchy/quadrature.h"

namespace holomorph {
namespace {

constexpr size_t kBatch = 2048;
constexpr size_t kNodes = 12;

/// The ends of a line's panels, as fractions of the line.
std::vector<double> panels_of(PolygonView polygon, const Line& line) {
  const double length = std::abs(line.to - line.from);
  constexpr int kMost = 2000;  // enough if the boundary is a thousandth of the line's length away
  std::vector<double> ends{0};
  while (ends.back() < 1 && static_cast<int>(ends.size()) < kMost) {
    const Complex here = line.from + ends.back() * (line.to - line.from);
    // A panel's length is 0.7 times the distance of its start from the polygon. The distance of its
    // midpoint from the polygon is then more than half a panel.
    const double room = nearest_on_polygon(polygon, here).distance, step = 0.7 * room / length;
    ends.push_back(step > 0 ? std::min(1.0, ends.back() + step) : 1);
  }
  ends.back() = 1;
  return ends;
}

struct Quadrature {
  Points points;
  std::vector<LineNode> nodes;
};

Quadrature quadrature_along(PolygonView polygon, std::span<const Line> lines) {
  const GaussRule& rule = gauss_rule(static_cast<int>(kNodes));
  Quadrature all;
  for (size_t i = 0; i < lines.size(); ++i) {
    const Complex direction = lines[i].to - lines[i].from;
    if (direction == Complex(0)) continue;
    const std::vector<double> ends = panels_of(polygon, lines[i]);
    for (size_t p = 0; p + 1 < ends.size(); ++p)
      for (size_t g = 0; g < kNodes; ++g) {
        const double length = ends[p + 1] - ends[p], fraction = ends[p] + length * rule.nodes[g];
        all.points.push_back(lines[i].from + fraction * direction);
        all.nodes.push_back({static_cast<Index>(i), length * rule.weights[g] * direction});
      }
  }
  return all;
}

/// The integrals of df along `count` lines, from Phi' and conj(Psi') at the nodes.
VectorXc sums_along(const std::vector<LineNode>& nodes, const Slopes& slopes, Index count) {
  VectorXc sums = VectorXc::Zero(count);
  for (size_t k = 0; k < nodes.size(); ++k) {
    const Index at = static_cast<Index>(k);
    sums[nodes[k].line] +=
        slopes.fz[at] * nodes[k].weight + slopes.fzbar[at] * std::conj(nodes[k].weight);
  }
  return sums;
}

}  // namespace

DerivativesAt evaluator_of(LogMap map) {
  return [map = std::move(map)](const MatrixXc& c) {
    return derivatives_of(map, c * map.l, c * map.w);
  };
}

Slopes slopes_at(const BoundaryBasis& basis, const DerivativesAt& map,
                 std::span<const Complex> points) {
  Slopes slopes{VectorXc(static_cast<Index>(points.size())),
                VectorXc(static_cast<Index>(points.size()))};
  for (size_t first = 0; first < points.size(); first += kBatch) {
    const size_t count = std::min(kBatch, points.size() - first);
    const Derivatives d = map(basis.values(points.subspan(first, count)));
    slopes.fz.segment(static_cast<Index>(first), static_cast<Index>(count)) = d.phi;
    slopes.fzbar.segment(static_cast<Index>(first), static_cast<Index>(count)) = d.psi.conjugate();
  }
  return slopes;
}

VectorXc increments_along(const BoundaryBasis& basis, const DerivativesAt& map,
                          std::span<const Line> lines) {
  const Quadrature all = quadrature_along(basis.polygon(), lines);
  return sums_along(all.nodes, slopes_at(basis, map, all.points), static_cast<Index>(lines.size()));
}

LineIntegrals::LineIntegrals(const BoundaryBasis& basis, std::span<const Line> lines)
    : count_(static_cast<Index>(lines.size())) {
  Quadrature all = quadrature_along(basis.polygon(), lines);
  nodes_ = std::move(all.nodes);
  values_ = basis.values(all.points);
}

VectorXc LineIntegrals::of(const DerivativesAt& map) const {
  const Derivatives d = map(values_);
  return sums_along(nodes_, {d.phi, d.psi.conjugate()}, count_);
}

VectorXc integrated_along(const MeshTree& tree, const BoundaryBasis& basis, const LogMap& map) {
  const Points& vertices = tree.mesh().vertices;
  std::vector<Line> lines;
  for (const auto [from, to] : tree.edges())
    lines.push_back({vertices[static_cast<size_t>(from)], vertices[static_cast<size_t>(to)]});
  const VectorXc increments = increments_along(basis, evaluator_of(map), lines);
  VectorXc f = VectorXc::Zero(static_cast<Index>(vertices.size()));
  for (size_t e = 0; e < lines.size(); ++e) {
    const auto [from, to] = tree.edges()[e];
    f[to] = f[from] + increments[static_cast<Index>(e)];
  }
  return f;
}

}  // namespace holomorph
