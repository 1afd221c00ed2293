// Cuts along mesh edges join the holes to the outer boundary. What remains is simply connected, so
// some path crosses a given cut once and no other cut. Paths run between midpoints of edges.
#include "core/mesh/hole_loops.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

#include "core/error.h"
#include "core/geometry/deepest_point.h"
#include "core/solvers/factors.h"

namespace holomorph {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
using Queue = std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>,
                                  std::greater<>>;

/// The edges of a mesh, with the triangles on both sides.
class EdgeGraph {
 public:
  EdgeGraph(const Mesh& mesh, PolygonView polygon)
      : mesh_(mesh), polygon_(polygon), at_vertex_(mesh.vertices.size()) {
    std::map<std::pair<int, int>, int> known;
    of_triangle_.resize(mesh.triangles.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      for (size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
        const auto [at, is_new] = known.try_emplace({a, b}, static_cast<int>(edges_.size()));
        if (is_new) {
          edges_.push_back({a, b, {}});
          at_vertex_[static_cast<size_t>(a)].push_back(at->second);
          at_vertex_[static_cast<size_t>(b)].push_back(at->second);
        }
        edge(at->second).triangles.push_back(static_cast<int>(t));
        of_triangle_[t][k] = at->second;
      }
    clearance_.assign(edges_.size(), -1);
    is_wall_.assign(edges_.size(), 0);
  }

  /// The shortest chain of edges from one of the `sources` to the first of the `targets`, marked by
  /// nonzero entries. Appends its vertices to `vertices`.
  std::vector<int> shortest_cut(const std::vector<char>& sources, const std::vector<char>& targets,
                                std::vector<int>& vertices) const {
    std::vector<double> distance(mesh_.vertices.size(), kUnreached);
    std::vector<int> before(mesh_.vertices.size(), -1);
    Queue queue;
    for (size_t v = 0; v < sources.size(); ++v)
      if (sources[v]) {
        distance[v] = 0;
        queue.push({0, static_cast<int>(v)});
      }
    while (!queue.empty()) {
      const auto [so_far, v] = queue.top();
      queue.pop();
      if (so_far > distance[static_cast<size_t>(v)]) continue;
      if (targets[static_cast<size_t>(v)]) return chain_to(v, before, vertices);
      for (const int e : at_vertex_[static_cast<size_t>(v)]) {
        const size_t to = static_cast<size_t>(edge(e).a == v ? edge(e).b : edge(e).a);
        const double length = so_far + std::abs(point(static_cast<int>(to)) - point(v));
        if (length >= distance[to]) continue;
        distance[to] = length;
        before[to] = e;
        queue.push({length, static_cast<int>(to)});
      }
    }
    check(false, "hole loops: the mesh is connected");
    return {};
  }

  /// Paths do not cross walls.
  void make_walls(const std::vector<int>& cut) {
    for (const int e : cut) is_wall_[static_cast<size_t>(e)] = 1;
  }

  /// A path that crosses one of the edges of a cut, and no other wall.
  Points path_across(const std::vector<int>& cut) {
    const int start = *std::ranges::max_element(cut, {}, [&](int e) { return clearance(e); });
    std::vector<double> distance(edges_.size(), kUnreached);
    std::vector<int> before(edges_.size(), -1);
    Queue queue;
    const auto reach = [&](int from, int to, double so_far) {
      if (is_wall_[static_cast<size_t>(to)] || edge(to).triangles.size() < 2) return;
      const double length = so_far + std::abs(middle(to) - middle(from)) / clearance(to);
      if (length >= distance[static_cast<size_t>(to)]) return;
      distance[static_cast<size_t>(to)] = length;
      before[static_cast<size_t>(to)] = from;
      queue.push({length, to});
    };
    const int first = edge(start).triangles[0], last = edge(start).triangles[1];
    for (const int e : of_triangle_[static_cast<size_t>(first)]) reach(start, e, 0);
    while (!queue.empty()) {
      const auto [so_far, e] = queue.top();
      queue.pop();
      if (so_far > distance[static_cast<size_t>(e)]) continue;
      if (std::ranges::find(edge(e).triangles, last) != edge(e).triangles.end()) {
        Points path{middle(e)};
        for (int at = e; at != start;) {
          at = before[static_cast<size_t>(at)];
          path.push_back(middle(at));
        }
        return path;
      }
      for (const int t : edge(e).triangles)
        for (const int to : of_triangle_[static_cast<size_t>(t)])
          if (to != e) reach(e, to, so_far);
    }
    check(false, "hole loops: the mesh is connected behind its cuts");
    return {};
  }

 private:
  struct Edge {
    int a, b;
    std::vector<int> triangles;
  };
  const Edge& edge(int e) const { return edges_[static_cast<size_t>(e)]; }
  Edge& edge(int e) { return edges_[static_cast<size_t>(e)]; }
  Complex point(int v) const { return mesh_.vertices[static_cast<size_t>(v)]; }
  Complex middle(int e) const { return 0.5 * (point(edge(e).a) + point(edge(e).b)); }
  double clearance(int e) {
    double& known = clearance_[static_cast<size_t>(e)];
    if (known < 0) known = nearest_on_polygon(polygon_, middle(e)).distance;
    return known;
  }
  std::vector<int> chain_to(int v, const std::vector<int>& before,
                            std::vector<int>& vertices) const {
    std::vector<int> chain;
    vertices.push_back(v);
    while (before[static_cast<size_t>(v)] >= 0) {
      const int e = before[static_cast<size_t>(v)];
      chain.push_back(e);
      v = edge(e).a == v ? edge(e).b : edge(e).a;
      vertices.push_back(v);
    }
    return chain;
  }

  const Mesh& mesh_;
  PolygonView polygon_;
  std::vector<std::vector<int>> at_vertex_;  ///< the edges at each vertex
  std::vector<Edge> edges_;
  std::vector<std::array<int, 3>> of_triangle_;
  std::vector<double> clearance_;  ///< -1: not known yet
  std::vector<char> is_wall_;
};

}  // namespace

HoleLoops::HoleLoops(const Mesh& mesh, PolygonView polygon) {
  const Loops loops = mesh.boundary_loops();
  check(polygon.loops().count() == loops.count(), "hole loops: the polygon has the same holes");
  if (loops.count() == 1) return;
  EdgeGraph graph(mesh, polygon);
  std::vector<char> joined(mesh.vertices.size(), 0), open(mesh.vertices.size(), 0);
  std::map<int, Index> loop_at;
  for (Index i = 0; i < static_cast<Index>(mesh.boundary.size()); ++i) {
    const int v = mesh.boundary[static_cast<size_t>(i)];
    loop_at[v] = loops.loop_of(i);
    (loops.loop_of(i) == 0 ? joined : open)[static_cast<size_t>(v)] = 1;
  }
  std::vector<std::vector<int>> cuts;
  for (Index hole = 1; hole < loops.count(); ++hole) {
    std::vector<int> vertices;
    cuts.push_back(graph.shortest_cut(joined, open, vertices));
    graph.make_walls(cuts.back());
    const Index reached = loop_at.at(vertices.front());
    for (Index i = loops.first(reached); i < loops.end(reached); ++i)
      vertices.push_back(mesh.boundary[static_cast<size_t>(i)]);
    for (const int v : vertices) {
      joined[static_cast<size_t>(v)] = 1;
      open[static_cast<size_t>(v)] = 0;
    }
  }
  for (const std::vector<int>& cut : cuts) paths_.push_back(graph.path_across(cut));
  const Index count = loops.count() - 1;
  windings_.resize(count, count);
  for (Index h = 0; h < count; ++h) {
    const auto hole = polygon.loop(h + 1);
    centers_.push_back(deepest_point(Polyline({hole.begin(), hole.end()}, true)));
    for (Index p = 0; p < count; ++p)
      windings_(p, h) = winding_number(paths_[static_cast<size_t>(p)], centers_.back());
  }
}

VectorXc HoleLoops::correction(const MeshTree& tree, const VectorXc& jumps) const {
  VectorXc correction = VectorXc::Zero(static_cast<Index>(tree.mesh().vertices.size()));
  if (paths_.empty()) return correction;
  const VectorXc around = solve_square(windings_.cast<Complex>(), jumps);
  for (size_t h = 0; h < centers_.size(); ++h)
    correction += around[static_cast<Index>(h)] / (2 * kPi) * tree.argument(centers_[h]);
  return correction;
}

}  // namespace holomorph
