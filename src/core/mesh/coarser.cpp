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

/// The barycentric coordinates of z in a triangle with this number.
Location location_in(const Mesh& mesh, const Triangle& t, int number, Complex z) {
  const auto side = [&](int k) { return mesh.vertices[static_cast<size_t>(t[k])] - z; };
  const Complex a = side(0), b = side(1), c = side(2);
  const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), area = wa + wb + wc;
  return {number, {wa / area, wb / area, wc / area}};
}

double least_weight(const Location& at) {
  return *std::ranges::min_element(at.weights);
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
    while (!waiting.empty() && least_weight(best) < 0) {
      const int i = waiting.back();
      waiting.pop_back();
      if (const Location here = weighted(i, z); least_weight(here) > least_weight(best))
        best = here;
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
  Location weighted(int triangle, Complex z) const {
    return location_in(mesh_, mesh_.triangles[static_cast<size_t>(triangle)], triangle, z);
  }

  const Mesh& mesh_;
  std::vector<std::vector<int>> around_;  ///< the triangles around each vertex
  std::vector<int> visited_;              ///< the last search that came to each triangle
  int search_ = 0;
};

/// Poses of a mesh, and how far a coarser mesh may be from them.
struct PoseLimit {
  std::span<const Points> poses;
  double tolerance;
};

class Collapse {
 public:
  explicit Collapse(const Mesh& mesh, std::optional<PoseLimit> limit = {})
      : mesh_(mesh),
        limit_(limit),
        inside_(mesh.triangles.size()),
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

  /// Repeats until() while it removes vertices, because a collapse can make others possible.
  /// Returns whether at most `count` vertices are left.
  bool reaches(size_t count) {
    for (size_t before = left_ + 1; left_ < before && left_ > count;) {
      before = left_;
      for (size_t v = 0; v < around_.size(); ++v)
        for (const int w : neighbors(static_cast<int>(v))) propose(static_cast<int>(v), w);
      until(count);
    }
    return left_ <= count;
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
    if (limit_) {
      out.locations = own_locations(mesh, number);
      return out;
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
  /// The locations of the finer mesh's vertices in the coarser mesh, as they were checked.
  std::vector<Location> own_locations(const Mesh& coarse, const std::vector<int>& number) const {
    std::vector<Location> all(around_.size());
    std::vector<char> found(around_.size(), 0);
    int triangle = 0;
    for (size_t i = 0; i < triangles_.size(); ++i) {
      if (is_removed(triangles_[i])) continue;
      const Triangle& t = coarse.triangles[static_cast<size_t>(triangle)];
      for (const int v : inside_[i]) {
        all[static_cast<size_t>(v)] = location_in(coarse, t, triangle, at(v));
        found[static_cast<size_t>(v)] = 1;
      }
      for (const int v : triangles_[i])
        if (!std::exchange(found[static_cast<size_t>(v)], char{1})) {
          Location& here = all[static_cast<size_t>(v)];
          here.triangle = triangle;
          for (size_t k = 0; k < 3; ++k)
            here.weights[k] = t[k] == number[static_cast<size_t>(v)] ? 1 : 0;
        }
      ++triangle;
    }
    return all;
  }

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
    constexpr double kRound = 0.15, kLeastRound = 0.03;
    const double enough = limit_ ? kLeastRound : kRound;
    return std::ranges::all_of(around(from), [&](int i) {
      const Triangle& t = triangle(i);
      if (has(t, to)) return true;
      const auto moved = [&](int k) { return at(t[k] == from ? to : t[k]); };
      return roundness(moved(0), moved(1), moved(2)) > enough;
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
      const double off = nearest_on_segment(start, end, at(v)).distance;
      return off <= kStraight * std::abs(end - start) && (!limit_ || off <= limit_->tolerance);
    });
  }

  /// Whether the vertices around `from` stay near their images in all poses if it moves. Finds the
  /// triangles in which they are then.
  bool keeps_poses(int from, int to) {
    moved_.clear();
    if (!limit_) return true;
    std::vector<int> vertices{from};
    for (const int i : around(from))
      vertices.insert(vertices.end(), inside_[static_cast<size_t>(i)].begin(),
                      inside_[static_cast<size_t>(i)].end());
    for (const int v : vertices) {
      std::optional<Location> best;
      Triangle corners{};
      for (const int i : around(from)) {
        Triangle t = triangle(i);
        if (has(t, to)) continue;
        std::ranges::replace(t, from, to);
        const Location here = location_in(mesh_, t, i, at(v));
        if (best && least_weight(here) <= least_weight(*best)) continue;
        best = here;
        corners = t;
      }
      if (!best) return false;
      for (const Points& pose : limit_->poses) {
        Complex there;
        for (size_t k = 0; k < 3; ++k)
          there += best->weights[k] * pose[static_cast<size_t>(corners[k])];
        if (std::abs(there - pose[static_cast<size_t>(v)]) > limit_->tolerance) return false;
      }
      moved_.emplace_back(v, best->triangle);
    }
    return true;
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
    if (!keeps_poses(from, to)) return false;
    for (const int i : around(from)) inside_[static_cast<size_t>(i)].clear();
    for (const auto& [v, i] : moved_) inside_[static_cast<size_t>(i)].push_back(v);
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
  std::optional<PoseLimit> limit_;
  /// With a limit, the removed vertices in each triangle, and those that a collapse moves, with
  /// their new triangles.
  std::vector<std::vector<int>> inside_;
  std::vector<std::pair<int, int>> moved_;
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

CoarserMesh coarsest_mesh(const Mesh& mesh, std::span<const Points> poses, double tolerance) {
  Collapse collapse(mesh, PoseLimit{poses, tolerance});
  collapse.reaches(3);
  return collapse.result();
}

CoarserMesh coarser_mesh(const Mesh& mesh, size_t count, std::span<const Points> poses) {
  constexpr int kTries = 10;
  constexpr double kLeast = 1e-5;  // of the size
  double most = box_of(mesh.vertices).diagonal(), least = kLeast * most;
  std::optional<CoarserMesh> best;
  for (int i = 0; i < kTries; ++i) {
    const double tolerance = std::sqrt(least * most);
    Collapse collapse(mesh, PoseLimit{poses, tolerance});
    const bool reached = collapse.reaches(std::max<size_t>(count, 3));
    (reached ? most : least) = tolerance;
    if (reached) best = collapse.result();
  }
  return best ? std::move(*best) : coarser_mesh(mesh, count);
}

}  // namespace holomorph
