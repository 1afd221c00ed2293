// A straight piece that is shorter than twice the distance of its midpoint from the polygon lies
// inside the polygon. Parts of a path with that property are replaced by their chords.
#include "core/mesh/path_tree.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

#include "core/cauchy/quadrature.h"
#include "core/error.h"

namespace holomorph {
namespace {

/// The length of the longest piece, in distances of its midpoint from the polygon.
constexpr double kReach = 1.5;

bool is_short(PolygonView polygon, Complex from, Complex to) {
  return std::abs(to - from) <= kReach * nearest_on_polygon(polygon, 0.5 * (from + to)).distance;
}

/// The edges of a mesh, and links from stations to the corners of their triangles. The stations
/// follow the mesh's vertices.
class Graph {
 public:
  Graph(const Mesh& mesh, const Points& stations)
      : points_(mesh.vertices), neighbors_(mesh.vertices.size() + stations.size()) {
    marks_ = boundary_marks(mesh);
    for (const Triangle& t : mesh.triangles)
      for (size_t k = 0; k < 3; ++k) link(t[k], t[(k + 1) % 3]);
    for (const Complex& z : stations) {
      const int station = static_cast<int>(points_.size());
      points_.push_back(z);
      marks_.push_back(0);
      for (const int corner : mesh.triangles[static_cast<size_t>(locate_near(mesh, z).triangle)])
        link(station, corner);
    }
  }

  /// For each vertex, the vertex before it on a shortest path from the root; -1 at the root.
  std::vector<int> parents(int root) const {
    // An edge at the boundary counts as much longer, so it is used only if necessary.
    constexpr double kBoundary = 1000;
    std::vector<double> distance(points_.size(), std::numeric_limits<double>::infinity());
    std::vector<int> parent(points_.size(), -1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[static_cast<size_t>(root)] = 0;
    queue.push({0, root});
    while (!queue.empty()) {
      const auto [so_far, from] = queue.top();
      queue.pop();
      if (so_far > distance[static_cast<size_t>(from)]) continue;
      for (const int to : neighbors_[static_cast<size_t>(from)]) {
        const double length =
            std::abs(point(to) - point(from)) * (marks_[static_cast<size_t>(to)] ? kBoundary : 1);
        if (so_far + length >= distance[static_cast<size_t>(to)]) continue;
        distance[static_cast<size_t>(to)] = so_far + length;
        parent[static_cast<size_t>(to)] = from;
        queue.push({so_far + length, to});
      }
    }
    return parent;
  }

  Complex point(int v) const { return points_[static_cast<size_t>(v)]; }

 private:
  void link(int a, int b) {
    neighbors_[static_cast<size_t>(a)].push_back(b);
    neighbors_[static_cast<size_t>(b)].push_back(a);
  }

  Points points_;
  std::vector<char> marks_;
  std::vector<std::vector<int>> neighbors_;
};

}  // namespace

PathTree::PathTree(const Mesh& mesh, PolygonView polygon, const Points& stations,
                   const std::vector<Points>& loops) {
  if (!stations.empty()) add_paths(mesh, polygon, stations);
  for (Points loop : loops) {
    loop.push_back(loop.front());
    add_pieces(loop, polygon, -1);
    loops_.push_back(static_cast<Index>(pieces_.size()) - 1);
  }
  set_nodes();
}

void PathTree::add_paths(const Mesh& mesh, PolygonView polygon, const Points& stations) {
  const Graph graph(mesh, stations);
  const int first = static_cast<int>(mesh.vertices.size());
  const std::vector<int> parent = graph.parents(first);

  // The vertices on paths, and how many paths continue from each of them.
  std::map<int, int> branches;
  std::vector<std::vector<int>> paths;
  for (size_t i = 0; i < stations.size(); ++i) {
    std::vector<int> path{first + static_cast<int>(i)};
    while (path.back() != first) {
      const int before = parent[static_cast<size_t>(path.back())];
      check(before >= 0, "path tree: the mesh is connected");
      const bool known = branches.contains(path.back());
      branches.try_emplace(path.back(), 0);
      if (!known) ++branches[before];
      path.push_back(before);
    }
    std::ranges::reverse(path);
    paths.push_back(std::move(path));
  }

  std::map<int, Index> piece_at{{first, -1}};  // the piece that ends at a vertex
  for (const std::vector<int>& path : paths) {
    Points line{graph.point(first)};
    Index before = -1;
    for (size_t k = 1; k < path.size(); ++k) {
      const int v = path[k];
      line.push_back(graph.point(v));
      if (v < first && branches[v] == 1 && k + 1 < path.size()) continue;
      if (const auto known = piece_at.find(v); known != piece_at.end()) {
        before = known->second;
      } else {
        add_pieces(line, polygon, before);
        before = static_cast<Index>(pieces_.size()) - 1;
        piece_at[v] = before;
      }
      line = {graph.point(v)};
    }
    ends_.push_back(before);
  }
}

void PathTree::add_pieces(const Points& line, PolygonView polygon, Index parent) {
  const auto add = [&](Complex from, Complex to) {
    pieces_.push_back({from, to, parent});
    parent = static_cast<Index>(pieces_.size()) - 1;
  };
  size_t at = 0;
  while (at + 1 < line.size()) {
    size_t end = at + 1;
    while (end + 1 < line.size() && is_short(polygon, line[at], line[end + 1])) ++end;
    // A mesh edge near the polygon is divided.
    Complex from = line[at];
    constexpr int kMost = 2000;
    for (int part = 0; !is_short(polygon, from, line[end]) && part < kMost; ++part) {
      Complex to = line[end];
      for (int halving = 0; !is_short(polygon, from, to) && halving < 60; ++halving)
        to = 0.5 * (from + to);
      add(from, to);
      from = to;
    }
    add(from, line[end]);
    at = end;
  }
}

void PathTree::set_nodes() {
  const GaussRule& rule = gauss_rule(kNodes);
  weights_.resize(static_cast<Index>(pieces_.size()) * kNodes);
  Index at = 0;
  for (const Piece& piece : pieces_) {
    const Complex direction = piece.to - piece.from;
    for (size_t g = 0; g < static_cast<size_t>(kNodes); ++g) {
      nodes_.push_back(piece.from + rule.nodes[g] * direction);
      weights_[at++] = rule.weights[g] * direction;
    }
  }
}

}  // namespace holomorph
