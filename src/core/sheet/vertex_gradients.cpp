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
    each.erase(std::unique(each.begin(), each.end()), each.end());
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
  found.erase(std::unique(found.begin(), found.end()), found.end());
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

/// The weights of values in one derivative.
using Weights = std::map<int, Complex>;

/// f_z at a vertex.
Weights fitted_slope(const Mesh& mesh, const Neighbors& around, int v) {
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
  Weights weights;
  for (Index i = 0; i < count; ++i) {
    const Complex weight = 0.5 / size * Complex(x[i], -y[i]);
    weights[near[static_cast<size_t>(i)]] = weight;
    weights[v] -= weight;
  }
  return weights;
}

Weights sum(Complex a, const Weights& first, Complex b, const Weights& second) {
  Weights both;
  for (const auto& [v, weight] : first) both[v] += a * weight;
  for (const auto& [v, weight] : second) both[v] += b * weight;
  return both;
}
/// The weights in f_zbar from those in f_z.
Weights conjugate(Weights weights) {
  for (auto& [v, weight] : weights) weight = std::conj(weight);
  return weights;
}

/// The derivative at vertex a along a line through it, per unit length in the direction of b: of
/// the quadratic through a, b and c.
Weights along(const Mesh& mesh, int a, int b, int c) {
  const auto at = [&](int v) { return mesh.vertices[static_cast<size_t>(v)]; };
  const Complex direction = (at(b) - at(a)) / std::abs(at(b) - at(a));
  const double s = std::abs(at(b) - at(a)), t = dot(at(c) - at(a), direction);
  const double by_b = t / (s * (t - s)), by_c = -s / (t * (t - s));
  return {{a, -by_b - by_c}, {b, by_b}, {c, by_c}};
}

/// f_z at a framed vertex whose neighbors along the outline are two before and two after it.
/// `inner` is the fit to all of its neighbors.
Weights framed_slopes(const Mesh& mesh, const std::array<int, 5>& side, const Weights& inner) {
  const auto way = [&](int from, int to) {
    const Complex d =
        mesh.vertices[static_cast<size_t>(to)] - mesh.vertices[static_cast<size_t>(from)];
    return d / std::abs(d);
  };
  constexpr double kStraight = 1e-6;
  const auto is_straight = [&](size_t at) {
    return std::abs(way(side[at - 1], side[at]) - way(side[at], side[at + 1])) < kStraight;
  };
  const Complex d = way(side[2], side[3]);
  if (is_straight(2)) {  // the fit's derivative across, f_n = i (f_z d - f_zbar conj(d))
    const Weights across = sum(kI * d, inner, -kI * std::conj(d), conjugate(inner));
    return sum(0.5 * std::conj(d), along(mesh, side[2], side[3], side[1]), -0.5 * kI * std::conj(d),
               across);
  }
  // At a corner, both sides have derivatives: e is the direction back.
  const Complex e = way(side[2], side[1]), both = d * std::conj(e) - e * std::conj(d);
  const auto one_sided = [&](int next, bool straight, int farther) {
    if (straight) return along(mesh, side[2], next, farther);
    const double length = std::abs(mesh.vertices[static_cast<size_t>(next)] -
                                   mesh.vertices[static_cast<size_t>(side[2])]);
    return Weights{{side[2], -1 / length}, {next, 1 / length}};
  };
  return sum(std::conj(e) / both, one_sided(side[3], is_straight(3), side[4]), -std::conj(d) / both,
             one_sided(side[1], is_straight(1), side[0]));
}

}  // namespace

VertexGradients::VertexGradients(const Mesh& mesh, std::span<const char> framed) {
  std::vector<Eigen::Triplet<Complex>> entries;
  const Neighbors around = neighbors_of(mesh);
  std::map<int, std::array<int, 5>> sides;
  const Loops loops = mesh.boundary_loops();
  for (Index i = 0; i < static_cast<Index>(mesh.boundary.size()); ++i) {
    const auto at = [&](Index k) { return mesh.boundary[static_cast<size_t>(k)]; };
    if (framed.empty() || framed[static_cast<size_t>(at(i))] == 0) continue;
    const Index before = loops.before(i), next = loops.next(i);
    sides[at(i)] = {at(loops.before(before)), at(before), at(i), at(next), at(loops.next(next))};
  }
  for (int v = 0; v < static_cast<int>(around.size()); ++v) {
    Weights weights = fitted_slope(mesh, around, v);
    if (const auto side = sides.find(v); side != sides.end())
      weights = framed_slopes(mesh, side->second, weights);
    for (const auto& [w, weight] : weights) entries.emplace_back(v, w, weight);
  }
  const Index n = static_cast<Index>(mesh.vertices.size());
  weights_.resize(n, n);
  weights_.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace holomorph
