// Collapses the shortest edges first. A collapse moves one end of an edge to the other, which
// removes the triangles next to the edge.
#include "core/mesh/coarser.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "core/geometry/polygon.h"

namespace holomorph {
namespace {

/// Twice the area of a triangle over the square of its longest side: 0.87 if it is equilateral, and
/// negative if it is clockwise.
double roundness(Complex a, Complex b, Complex c) {
  return cross(b - a, c - a) / std::max({std::norm(b - a), std::norm(c - b), std::norm(a - c)});
}

/// Locates points near given vertices.
class NearbyTriangles {
 public:
  explicit NearbyTriangles(const Mesh& mesh)
      : mesh_(mesh), around_(mesh.vertices.size()), visited_(mesh.triangles.size(), 0) {
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
      for (const int v : mesh.triangles[i])
        around_[static_cast<size_t>(v)].push_back(static_cast<int>(i));
  }

  /// The triangle in which the smallest barycentric coordinate of z is largest, among those within
  /// the distance of a vertex from z that are connected with it within this distance.
  Location location(int vertex, Complex z) {
    ++search_;
    const double reach = std::abs(mesh_.vertices[static_cast<size_t>(vertex)] - z);
    std::vector<int> waiting;
    const auto visit = [&](int v) {
      for (const int i : around_[static_cast<size_t>(v)])
        if (std::exchange(visited_[static_cast<size_t>(i)], search_) != search_)
          waiting.push_back(i);
    };
    visit(vertex);
    Location best = weighted(waiting.front(), z);
    while (!waiting.empty() && least(best) < 0) {
      const int i = waiting.back();
      waiting.pop_back();
      if (const Location here = weighted(i, z); least(here) > least(best)) best = here;
      const Triangle& t = mesh_.triangles[static_cast<size_t>(i)];
      for (size_t k = 0; k < 3; ++k) {
        const auto corner = [&](size_t j) { return mesh_.vertices[static_cast<size_t>(t[j % 3])]; };
        if (nearest_on_segment(corner(k), corner(k + 1), z).distance > reach) continue;
        visit(t[k]);
        visit(t[(k + 1) % 3]);
      }
    }
    return best;
  }

 private:
  static double least(const Location& at) { return *std::ranges::min_element(at.weights); }

  Location weighted(int triangle, Complex z) const {
    const Triangle& t = mesh_.triangles[static_cast<size_t>(triangle)];
    const auto side = [&](int k) { return mesh_.vertices[static_cast<size_t>(t[k])] - z; };
    const Complex a = side(0), b = side(1), c = side(2);
    const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), area = wa + wb + wc;
    return {triangle, {wa / area, wb / area, wc / area}};
  }

  const Mesh& mesh_;
  std::vector<std::vector<int>> around_;  ///< the triangles around each vertex
  std::vector<int> visited_;              ///< the last search that came to each triangle
  int search_ = 0;
};

class Collapse {
 public:
  explicit Collapse(const Mesh& mesh)
      : mesh_(mesh),
        on_boundary_(boundary_marks(mesh)),
        triangles_(mesh.triangles),
        around_(mesh.vertices.size()),
        into_(mesh.vertices.size()),
        loops_(mesh.boundary_loops()),
        place_(mesh.vertices.size(), -1),
        left_(mesh.vertices.size()) {
    std::iota(into_.begin(), into_.end(), 0);
    for (size_t i = 0; i < mesh.boundary.size(); ++i)
      place_[static_cast<size_t>(mesh.boundary[i])] = static_cast<Index>(i);
    for (size_t i = 0; i < triangles_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        around(triangles_[i][k]).push_back(static_cast<int>(i));
        propose(triangles_[i][k], triangles_[i][(k + 1) % 3]);
      }
  }

  void until(size_t count) {
    while (left_ > count && !shortest_.empty()) {
      const auto [length, a, b] = shortest_.top();
      shortest_.pop();
      if (!collapse(a, b)) collapse(b, a);
    }
  }

  CoarserMesh result() const {
    CoarserMesh out;
    Mesh& mesh = out.mesh;
    std::vector<int> number(around_.size(), -1);
    for (size_t v = 0; v < around_.size(); ++v) {
      if (around_[v].empty()) continue;
      number[v] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(mesh_.vertices[v]);
      out.kept.push_back(static_cast<int>(v));
    }
    for (Triangle t : triangles_) {
      if (is_removed(t)) continue;
      for (int& v : t) v = number[static_cast<size_t>(v)];
      mesh.triangles.push_back(t);
    }
    const Loops loops = mesh_.boundary_loops();
    for (Index loop = 0; loop < loops.count(); ++loop) {
      if (loop > 0) mesh.starts.push_back(static_cast<Index>(mesh.boundary.size()));
      for (Index i = loops.first(loop); i < loops.end(loop); ++i)
        if (const int v = number[static_cast<size_t>(mesh_.boundary[static_cast<size_t>(i)])];
            v >= 0)
          mesh.boundary.push_back(v);
    }
    NearbyTriangles nearby(mesh);
    for (size_t v = 0; v < around_.size(); ++v) {
      size_t end = v;
      while (into_[end] != static_cast<int>(end)) end = static_cast<size_t>(into_[end]);
      out.locations.push_back(nearby.location(number[end], mesh_.vertices[v]));
    }
    return out;
  }

 private:
  static bool has(const Triangle& t, int v) { return std::ranges::find(t, v) != t.end(); }
  static bool is_removed(const Triangle& t) { return t[0] < 0; }
  std::vector<int>& around(int v) { return around_[static_cast<size_t>(v)]; }
  Triangle& triangle(int i) { return triangles_[static_cast<size_t>(i)]; }
  Complex at(int v) const { return mesh_.vertices[static_cast<size_t>(v)]; }
  bool on_boundary(int v) const { return on_boundary_[static_cast<size_t>(v)] != 0; }

  void propose(int a, int b) { shortest_.emplace(std::norm(at(a) - at(b)), a, b); }

  std::vector<int> neighbors(int v) {
    std::vector<int> found;
    for (const int i : around(v))
      for (const int w : triangle(i))
        if (w != v) found.push_back(w);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  /// Whether the triangles around `from` stay counter-clockwise and round enough if it moves.
  bool keeps_shapes(int from, int to) {
    constexpr double kRoundEnough = 0.15;
    return std::ranges::all_of(around(from), [&](int i) {
      const Triangle& t = triangle(i);
      if (has(t, to)) return true;
      const auto moved = [&](int k) { return at(t[k] == from ? to : t[k]); };
      return roundness(moved(0), moved(1), moved(2)) > kRoundEnough;
    });
  }

  /// Whether the boundary keeps its shape if `from` moves along it: whether the vertices of the
  /// finer mesh between the ends of the new edge lie close to that edge.
  bool keeps_boundary(int from) const {
    constexpr double kStraight = 0.05;
    std::vector<int> between{from};
    const auto walk = [&](auto step) {
      Index i = step(place_[static_cast<size_t>(from)]);
      const auto vertex = [&] { return mesh_.boundary[static_cast<size_t>(i)]; };
      for (; into_[static_cast<size_t>(vertex())] != vertex(); i = step(i))
        between.push_back(vertex());
      return at(vertex());
    };
    const Complex start = walk([&](Index i) { return loops_.before(i); });
    const Complex end = walk([&](Index i) { return loops_.next(i); });
    return std::ranges::all_of(between, [&](int v) {
      return nearest_on_segment(start, end, at(v)).distance <= kStraight * std::abs(end - start);
    });
  }

  /// Moves `from` to its neighbor `to`, if that is possible.
  bool collapse(int from, int to) {
    const auto common =  // triangles
        std::ranges::count_if(around(from), [&](int i) { return has(triangle(i), to); });
    if (common == 0 || (on_boundary(from) && (!on_boundary(to) || common != 1))) return false;
    // If the ends have another common neighbor, the mesh would be pinched or a hole closed.
    std::vector<int> shared;
    std::ranges::set_intersection(neighbors(from), neighbors(to), std::back_inserter(shared));
    if (std::ssize(shared) != common || !keeps_shapes(from, to)) return false;
    if (on_boundary(from) && !keeps_boundary(from)) return false;
    for (const int i : std::exchange(around(from), {})) {
      Triangle& t = triangle(i);
      if (has(t, to)) {
        for (const int v : t) std::erase(around(v), i);
        t = {-1, -1, -1};
      } else {
        std::ranges::replace(t, from, to);
        around(to).push_back(i);
      }
    }
    into_[static_cast<size_t>(from)] = to;
    --left_;
    for (const int w : neighbors(to)) propose(to, w);
    return true;
  }

  const Mesh& mesh_;
  std::vector<char> on_boundary_;
  std::vector<Triangle> triangles_;           ///< removed ones have negative corners
  std::vector<std::vector<int>> around_;      ///< the triangles around each vertex
  std::vector<int> into_;                     ///< where each vertex has moved; itself if it is left
  Loops loops_;                               ///< of the finer mesh's boundary
  std::vector<Index> place_;                  ///< where each vertex is on it, or -1
  size_t left_;                               ///< vertices that are left
  using Edge = std::tuple<double, int, int>;  // squared length and ends
  std::priority_queue<Edge, std::vector<Edge>, std::greater<>> shortest_;
};

}  // namespace

CoarserMesh coarser_mesh(const Mesh& mesh, size_t count) {
  Collapse collapse(mesh);
  collapse.until(std::max<size_t>(count, 3));
  return collapse.result();
}

}  // namespace holomorph
