// Winding numbers over triangles are sums of increments over edges, so that they add up to the
// boundary's.
#include "core/argument.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace holomorph {
namespace {

/// arg(b / a) in (-pi, pi], the exact opposite from b to a.
double increment(Complex a, Complex b) {
  return std::atan2(cross(a, b), dot(a, b));
}

/// The increment along an undirected edge, found from its lower vertex to its higher.
double edge_increment(const VectorXc& values, int from, int to) {
  return from < to ? increment(values[from], values[to]) : -increment(values[to], values[from]);
}

}  // namespace

std::vector<Zero> zeros_of(const Mesh& mesh, const VectorXc& values) {
  std::vector<Zero> zeros;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double turn =
        edge_increment(values, a, b) + edge_increment(values, b, c) + edge_increment(values, c, a);
    const int winding = static_cast<int>(std::lround(turn / (2 * kPi)));
    if (winding != 0)
      zeros.push_back({(mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0, winding});
  }
  return zeros;
}

VectorXd boundary_argument(std::span<const Complex> samples, const VectorXc& values,
                           const std::vector<Zero>& zeros) {
  const Index m = values.size();
  check(m > 2 && static_cast<Index>(samples.size()) == m, "boundary_argument: sizes agree");
  VectorXd steps(m);
  for (Index i = 0; i < m; ++i) {
    if (values[i] == Complex(0) || !is_finite(values[i]))
      throw Error(ErrorKind::failed, "the reference map has no direction at a boundary sample",
                  samples[static_cast<size_t>(i)]);
    steps[i] = increment(values[i], values[(i + 1) % m]);
  }
  int turns = static_cast<int>(std::lround(steps.sum() / (2 * kPi)));
  const auto jump = [&](Index sample, int count) {
    steps[sample] -= 2 * kPi * count;
    turns -= count;
  };
  for (const Zero& zero : zeros) {
    const auto nearest =
        std::ranges::min_element(samples, {}, [&](Complex z) { return std::norm(z - zero.place); });
    jump(nearest - samples.begin(), zero.multiplicity);
  }
  if (turns != 0) {
    std::vector<Index> order(static_cast<size_t>(m));
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, {}, [&](Index i) { return std::norm(values[i]); });
    for (size_t i = 0; turns != 0; ++i) jump(order[i % order.size()], turns > 0 ? 1 : -1);
  }
  VectorXd theta(m);
  theta[0] = std::arg(values[0]);
  for (Index i = 1; i < m; ++i) theta[i] = theta[i - 1] + steps[i - 1];
  return theta;
}

}  // namespace holomorph
