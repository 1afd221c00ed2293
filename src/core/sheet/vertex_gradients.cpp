#include "core/sheet/vertex_gradients.h"

#include <algorithm>

#include "core/solvers/factors.h"

namespace holomorph {
namespace {

using Neighbors = std::vector<std::vector<int>>;

Neighbors neighbors_of(const Mesh& mesh) {
  Neighbors around(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k)
      for (const size_t other : {(k + 1) % 3, (k + 2) % 3})
        around[static_cast<size_t>(t[k])].push_back(t[other]);
  for (std::vector<int>& each : around) {
    std::ranges::sort(each);
    each.erase(std::ranges::unique(each).begin(), each.end());
  }
  return around;
}

/// The neighbors that a vertex's quadratic fits.
std::vector<int> fitted(const Neighbors& around, int vertex) {
  constexpr size_t kEnough = 6;  // a quadratic through the vertex has five coefficients
  std::vector<int> found = around[static_cast<size_t>(vertex)];
  if (found.size() >= kEnough) return found;
  for (const int near : around[static_cast<size_t>(vertex)])
    for (const int next : around[static_cast<size_t>(near)])
      if (next != vertex) found.push_back(next);
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

/// The weights of values in the fit's derivatives in x and in y. The rows of the fit, transposed,
/// are multiplied by the closeness of their points.
std::array<VectorXd, 2> fitted_slopes(const MatrixXd& transposed, const VectorXd& closeness) {
  const ShortestLeastSquares fit(transposed);
  std::array<VectorXd, 2> slopes{fit.solve(VectorXd::Unit(5, 0)).cwiseProduct(closeness),
                                 fit.solve(VectorXd::Unit(5, 1)).cwiseProduct(closeness)};
  // Points near a conic through the vertex hardly determine a quadratic. Then a small one is taken.
  constexpr double kLargest = 20, kSmall = 0.05;
  if (std::max(slopes[0].norm(), slopes[1].norm()) <= kLargest) return slopes;
  MatrixXd normal = transposed * transposed.transpose();
  for (Index i = 2; i < 5; ++i) normal(i, i) += kSmall * kSmall * closeness.squaredNorm();
  const MatrixXd rows = solve_symmetric_all(normal, transposed * closeness.asDiagonal());
  return {VectorXd(rows.row(0)), VectorXd(rows.row(1))};
}

}  // namespace

VertexGradients::VertexGradients(const Mesh& mesh) {
  const Neighbors around = neighbors_of(mesh);
  std::vector<Eigen::Triplet<Complex>> entries;
  for (int v = 0; v < static_cast<int>(around.size()); ++v) {
    const std::vector<int> near = fitted(around, v);
    const Index count = static_cast<Index>(near.size());
    double size = 0;
    for (const int w : near)
      size = std::max(size, std::abs(mesh.vertices[static_cast<size_t>(w)] -
                                     mesh.vertices[static_cast<size_t>(v)]));
    // The transposed rows of the fit, in units of the farthest neighbor's distance. Near neighbors
    // count more.
    MatrixXd transposed(5, count);
    VectorXd closeness(count);
    for (Index i = 0; i < count; ++i) {
      const Complex d = (mesh.vertices[static_cast<size_t>(near[static_cast<size_t>(i)])] -
                         mesh.vertices[static_cast<size_t>(v)]) /
                        size;
      closeness[i] = 1 / std::abs(d);
      transposed.col(i) << d.real(), d.imag(), d.real() * d.real() / 2, d.real() * d.imag(),
          d.imag() * d.imag() / 2;
      transposed.col(i) *= closeness[i];
    }
    const auto [x, y] = fitted_slopes(transposed, closeness);
    Complex own = 0;
    for (Index i = 0; i < count; ++i) {
      const Complex weight = 0.5 / size * Complex(x[i], -y[i]);
      entries.emplace_back(v, near[static_cast<size_t>(i)], weight);
      own -= weight;
    }
    entries.emplace_back(v, v, own);
  }
  const Index n = static_cast<Index>(mesh.vertices.size());
  weights_.resize(n, n);
  weights_.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace holomorph
