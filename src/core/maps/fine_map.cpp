// First bisects the edges at whose middle the cubic misses the map, and the longest edges of their
// triangles, so that angles stay bounded. Then divides each cubic evenly, into a number of pieces
// that is a power of two. Where neighbors differ, the finer one follows the coarser one's edge.
#include "core/maps/fine_map.h"

#include <algorithm>
#include <unordered_map>

#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/maps/arc.h"
#include "core/maps/triangle_cubic.h"

namespace holomorph {
namespace {

constexpr double kCubicShare = 0.3, kLinearShare = 0.5;  ///< of the tolerance
constexpr double kShortest = 1e-10;                      ///< an edge that is not cut, of the mesh
constexpr int kMostPieces = 128;                         ///< along an edge
constexpr size_t kMostTriangles = 20'000'000;

using Value = PointMap::Value;

/// The derivative of the map in the direction d.
Complex along(const Value& at, Complex d) {
  return at.fz * d + at.fzbar * std::conj(d);
}

bool is_finite(const Value& at) {
  return holomorph::is_finite(at.f) && holomorph::is_finite(at.fz) &&
         holomorph::is_finite(at.fzbar);
}

/// The Bezier points of the cubic along an edge.
std::array<Complex, 4> cubic_between(Complex a, const Value& at_a, Complex b, const Value& at_b) {
  const Complex third = (b - a) / 3.0;
  return {at_a.f, at_a.f + along(at_a, third), at_b.f - along(at_b, third), at_b.f};
}

/// The larger second difference of a cubic's Bezier points.
double bend_of(const std::array<Complex, 4>& p) {
  return std::max(std::abs(p[0] - 2.0 * p[1] + p[2]), std::abs(p[1] - 2.0 * p[2] + p[3]));
}

/// The smallest power of two that is at least x.
int power_of_two_above(double x) {
  int power = 1;
  while (power < x && power < kMostPieces) power *= 2;
  return power;
}

struct Edge {
  int a, b;
  Arc arc;
  Complex middle;   ///< a point of the arc
  Value at_middle;  ///< the map there
  bool is_known = false, is_cut = false;
  int vertex = -1;  ///< at the middle, when the edge has been cut
  int pieces = 1;   ///< when it is not cut: the linear pieces
  int first = 0;    ///< the vertex that ends the first of several pieces
};

struct Piece {
  Triangle v;
  std::array<int, 3> edges;  ///< edge k leads from corner k to the next one, in some direction
};

/// The triangles in which the map is nearly cubic.
class Cubics {
 public:
  Cubics(const Cage& rest, const Mesh& mesh, double tolerance, bool is_piecewise,
         const PointValues& values_at)
      : rest_(oriented(rest)),
        mesh_(mesh),
        tolerance_(tolerance),
        is_piecewise_(is_piecewise),
        shortest_(kShortest * box_of(mesh.vertices).diagonal()),
        values_at_(values_at),
        vertices_(mesh.vertices),
        values_(evaluated(mesh.vertices)) {
    for (const Triangle& t : mesh.triangles) pieces_.push_back(piece(t));
    const std::vector<Arc> arcs = boundary_arcs(rest_, mesh);
    const Loops loops = mesh.boundary_loops();
    for (size_t i = 0; i < arcs.size(); ++i) {
      const int next = mesh.boundary[static_cast<size_t>(loops.next(static_cast<Index>(i)))];
      Edge& edge = edges_[static_cast<size_t>(edge_between(mesh.boundary[i], next))];
      edge.arc = edge.a == mesh.boundary[i] ? arcs[i] : reversed(arcs[i]);
    }
    for (;;) {
      const bool any_edge = mark_edges();  // evaluates the middles that mark_kinked needs
      if (!mark_kinked() && !any_edge) break;
      mark_longest();
      cut();
      check_size(pieces_.size());
    }
  }

  FineMap linear_pieces() {
    FineMap fine;
    fine.error = error_;
    fine.evaluations = evaluations_;
    fine.mesh.vertices = vertices_;
    for (const Value& at : values_) fine.f.push_back(at.f);
    for (Edge& edge : edges_)
      if (edge.vertex < 0) divide_edge(edge, fine);
    for (const Piece& piece : pieces_) {
      divide(piece, fine);
      check_size(fine.mesh.triangles.size());
    }
    set_boundary(fine.mesh);
    return fine;
  }

 private:
  static void check_size(size_t triangles) {
    if (triangles > kMostTriangles)
      throw Error(ErrorKind::bad_input,
                  "the picture is bent too much to be mapped at this size; choose a smaller scale");
  }

  static Arc reversed(const Arc& arc) {
    return {arc.to, arc.from, arc.segment, arc.end, arc.start};
  }

  std::vector<Value> evaluated(const Points& points) {
    evaluations_ += points.size();
    return values_at_(points);
  }

  int edge_between(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
    const auto [found, is_new] = edge_of_.try_emplace(key, static_cast<int>(edges_.size()));
    if (is_new) edges_.push_back({a, b, {vertices_[a], vertices_[b]}, {}, {}});
    return found->second;
  }

  Piece piece(const Triangle& t) {
    return {t, {edge_between(t[0], t[1]), edge_between(t[1], t[2]), edge_between(t[2], t[0])}};
  }

  /// Evaluates the map at the middles of edges, and marks the edges where a cubic is not accurate
  /// enough. Returns whether there are any.
  bool mark_edges() {
    Points points;
    std::vector<int> asked;
    for (size_t e = 0; e < edges_.size(); ++e) {
      Edge& edge = edges_[e];
      if (edge.is_known) continue;
      edge.middle = point_on(rest_, edge.arc, 0.5);
      points.push_back(edge.middle);
      asked.push_back(static_cast<int>(e));
    }
    const std::vector<Value> values = evaluated(points);
    size_t next = 0;
    bool any = false;
    for (const int e : asked) {
      Edge& edge = edges_[static_cast<size_t>(e)];
      edge.at_middle = values[next++];
      edge.is_known = true;
      any = (edge.is_cut = must_be_cut(edge)) || any;
    }
    return any;
  }

  bool must_be_cut(const Edge& edge) {
    const Complex a = vertices_[edge.a], b = vertices_[edge.b], off = edge.middle - 0.5 * (a + b);
    const Value &at_a = values_[edge.a], &at_b = values_[edge.b];
    if (!is_finite(at_a) || !is_finite(at_b) || !is_finite(edge.at_middle)) return false;
    const auto p = cubic_between(a, at_a, b, at_b);
    const Complex cubic = (p[0] + 3.0 * (p[1] + p[2]) + p[3]) / 8.0;
    // A remainder of degree five vanishes at the middle, but its slope there does not: it is up to
    // 7 times the remainder.
    const Complex slope = 0.75 * (p[3] - p[0] + p[2] - p[1]);
    const double miss = std::max(std::abs(edge.at_middle.f - along(edge.at_middle, off) - cubic),
                                 std::abs(along(edge.at_middle, b - a) - slope) / 7);
    const bool is_long = std::abs(b - a) > shortest_;
    if (is_long && (std::max(miss, std::abs(off)) > kCubicShare * tolerance_ ||
                    pieces_for(bend_of(p)) > kMostPieces))
      return true;
    error_ = std::max(error_, miss);
    return false;
  }

  /// For maps that are put together from pieces: marks the longest edges of triangles in which the
  /// map is not nearly cubic, although it is along the edges.
  bool mark_kinked() {
    constexpr double kCenter = 6.0 / 27;  // the weight of the inner Bezier point at the center
    if (!is_piecewise_) return false;
    bool any = false;
    for (const Piece& piece : pieces_) {
      const auto suggested = inner_points(piece);
      const double spread =
          std::max({std::abs(suggested[1] - suggested[0]), std::abs(suggested[2] - suggested[1]),
                    std::abs(suggested[0] - suggested[2])});
      Edge& edge = edges_[static_cast<size_t>(longest(piece))];
      if (!(kCenter * spread > kCubicShare * tolerance_) || !(length(edge) > shortest_)) continue;
      edge.is_cut = any = true;
    }
    return any;
  }

  double length(const Edge& edge) const { return std::abs(vertices_[edge.b] - vertices_[edge.a]); }

  /// The longest edge of a piece.
  int longest(const Piece& piece) const {
    return *std::ranges::max_element(piece.edges, {}, [&](int e) {
      return std::pair(length(edges_[static_cast<size_t>(e)]), e);
    });
  }

  void mark_longest() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const Piece& piece : pieces_) {
        const auto is_cut = [&](int e) { return edges_[static_cast<size_t>(e)].is_cut; };
        if (std::ranges::none_of(piece.edges, is_cut)) continue;
        Edge& edge = edges_[static_cast<size_t>(longest(piece))];
        changed = changed || !edge.is_cut;
        edge.is_cut = true;
      }
    }
  }

  /// Cuts the marked edges and their pieces.
  void cut() {
    for (size_t e = 0; e < edges_.size(); ++e) {
      if (!edges_[e].is_cut || edges_[e].vertex >= 0) continue;
      const Edge edge = edges_[e];  // the list grows
      const int vertex = edges_[e].vertex = static_cast<int>(vertices_.size());
      vertices_.push_back(edge.middle);
      values_.push_back(edge.at_middle);
      const auto [before, after] = cut_arc(rest_, edge.arc, 0.5);
      edges_[static_cast<size_t>(edge_between(edge.a, vertex))].arc = before;
      edges_[static_cast<size_t>(edge_between(vertex, edge.b))].arc = after;
    }
    std::vector<Piece> pieces;
    for (const Piece& whole : pieces_) {
      const int first = longest(whole);
      if (edges_[static_cast<size_t>(first)].vertex < 0) {
        pieces.push_back(whole);
        continue;
      }
      const size_t k =
          static_cast<size_t>(std::ranges::find(whole.edges, first) - whole.edges.begin());
      const auto corner = [&](size_t i) { return whole.v[(k + i) % 3]; };
      const auto middle = [&](size_t i) {
        return edges_[static_cast<size_t>(whole.edges[(k + i) % 3])].vertex;
      };
      const int a = corner(0), b = corner(1), c = corner(2), m = middle(0);
      const auto add = [&](int p, int q, int r) { pieces.push_back(piece({p, q, r})); };
      if (const int ca = middle(2); ca >= 0) {
        add(a, m, ca);
        add(ca, m, c);
      } else {
        add(a, m, c);
      }
      if (const int bc = middle(1); bc >= 0) {
        add(m, b, bc);
        add(m, bc, c);
      } else {
        add(m, b, c);
      }
    }
    pieces_ = std::move(pieces);
  }

  /// Linear interpolation misses a quadratic by an eighth of its second difference.
  double pieces_for(double second_difference) const {
    return std::sqrt(6 * second_difference / (8 * kLinearShare * tolerance_));
  }

  void divide_edge(Edge& edge, FineMap& fine) const {
    const Complex a = vertices_[edge.a], b = vertices_[edge.b];
    const auto p = cubic_between(a, values_[edge.a], b, values_[edge.b]);
    edge.pieces = power_of_two_above(pieces_for(bend_of(p)));
    edge.first = static_cast<int>(fine.f.size());
    for (int i = 1; i < edge.pieces; ++i) {
      const double t = static_cast<double>(i) / edge.pieces, s = 1 - t;
      fine.mesh.vertices.push_back(s * a + t * b);
      fine.f.push_back(s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] +
                       t * t * t * p[3]);
    }
  }

  /// The vertex at i of n equal parts of an edge, from its end `from`. If the edge has fewer
  /// pieces, the vertex lies on one of these.
  int vertex_on(const Edge& edge, int from, int i, int n, FineMap& fine) const {
    if (from != edge.a) i = n - i;
    const int each = n / edge.pieces;
    const auto end = [&](int k) {
      return k == 0 ? edge.a : k == edge.pieces ? edge.b : edge.first + k - 1;
    };
    const int before = end(i / each);
    if (i % each == 0) return before;
    const int after = end(i / each + 1);
    const double t = static_cast<double>(i % each) / each;
    const auto between = [t](Complex p, Complex q) { return (1 - t) * p + t * q; };
    fine.mesh.vertices.push_back(between(fine.mesh.vertices[before], fine.mesh.vertices[after]));
    fine.f.push_back(between(fine.f[before], fine.f[after]));
    return static_cast<int>(fine.f.size()) - 1;
  }

  std::array<std::array<Complex, 4>, 3> sides_of(const Piece& piece) const {
    std::array<std::array<Complex, 4>, 3> side;
    for (size_t k = 0; k < 3; ++k) {
      const int from = piece.v[k], to = piece.v[(k + 1) % 3];
      side[k] = cubic_between(vertices_[from], values_[from], vertices_[to], values_[to]);
    }
    return side;
  }

  TriangleCubic cubic_of(const Piece& piece) const {
    const auto side = sides_of(piece);
    TriangleCubic cubic;
    cubic(3, 0) = side[0][0], cubic(2, 1) = side[0][1], cubic(1, 2) = side[0][2];
    cubic(0, 3) = side[1][0], cubic(0, 2) = side[1][1], cubic(0, 1) = side[1][2];
    cubic(0, 0) = side[2][0], cubic(1, 0) = side[2][1], cubic(2, 0) = side[2][2];
    const auto suggested = inner_points(piece);
    cubic(1, 1) = (suggested[0] + suggested[1] + suggested[2]) / 3.0;
    return cubic;
  }

  /// The inner Bezier points for which the derivative across each edge is right.
  std::array<Complex, 3> inner_points(const Piece& piece) const {
    const auto side = sides_of(piece);
    std::array<Complex, 3> inner;
    for (size_t k = 0; k < 3; ++k) {
      const auto& p = side[k];
      const Complex a = vertices_[piece.v[k]], b = vertices_[piece.v[(k + 1) % 3]],
                    c = vertices_[piece.v[(k + 2) % 3]], beside_a = side[(k + 2) % 3][2],
                    beside_b = side[(k + 1) % 3][1];
      const Edge& edge = edges_[static_cast<size_t>(piece.edges[k])];
      inner[k] = 2.0 / 3.0 * along(edge.at_middle, c - 0.5 * (a + b)) + 0.25 * (p[0] + p[3]) +
                 0.75 * (p[1] + p[2]) - 0.5 * (beside_a + beside_b);
    }
    return inner;
  }

  void divide(const Piece& piece, FineMap& fine) const {
    const TriangleCubic cubic = cubic_of(piece);
    if (!cubic.is_finite()) return;
    const auto edge = [&](size_t k) -> const Edge& {
      return edges_[static_cast<size_t>(piece.edges[k])];
    };
    const int n = std::max({power_of_two_above(pieces_for(cubic.bend())), edge(0).pieces,
                            edge(1).pieces, edge(2).pieces});
    const int a = piece.v[0], b = piece.v[1], c = piece.v[2];
    const auto vertex = [&](int row, int i) {  // row 0 is the edge from a to b, row n is c
      if (row == 0) return vertex_on(edge(0), a, i, n, fine);
      if (i == n - row) return vertex_on(edge(1), b, row, n, fine);
      if (i == 0) return vertex_on(edge(2), c, n - row, n, fine);
      const double w = static_cast<double>(row) / n, v = static_cast<double>(i) / n, u = 1 - v - w;
      fine.mesh.vertices.push_back(u * vertices_[a] + v * vertices_[b] + w * vertices_[c]);
      fine.f.push_back(cubic.at(u, v, w));
      return static_cast<int>(fine.f.size()) - 1;
    };
    std::vector<int> below, above;
    for (int i = 0; i <= n; ++i) below.push_back(vertex(0, i));
    for (int row = 1; row <= n; ++row) {
      above.clear();
      for (int i = 0; i <= n - row; ++i) above.push_back(vertex(row, i));
      for (size_t i = 0; i < above.size(); ++i) {
        fine.mesh.triangles.push_back({below[i], below[i + 1], above[i]});
        if (i + 1 < above.size())
          fine.mesh.triangles.push_back({below[i + 1], above[i + 1], above[i]});
      }
      below.swap(above);
    }
  }

  void set_boundary(Mesh& mesh) {
    const Loops loops = mesh_.boundary_loops();
    for (size_t i = 0; i < mesh_.boundary.size(); ++i) {
      const Index at = static_cast<Index>(i);
      if (std::ranges::binary_search(mesh_.starts, at))
        mesh.starts.push_back(static_cast<Index>(mesh.boundary.size()));
      add_boundary(mesh_.boundary[i], mesh_.boundary[static_cast<size_t>(loops.next(at))], mesh);
    }
    mesh.cage_vertices = mesh_.cage_vertices;
  }

  /// Adds the vertices from one vertex to another, which is left out.
  void add_boundary(int from, int to, Mesh& mesh) {
    const Edge& edge = edges_[static_cast<size_t>(edge_between(from, to))];
    if (const int middle = edge.vertex; middle >= 0) {
      add_boundary(from, middle, mesh);
      add_boundary(middle, to, mesh);
      return;
    }
    mesh.boundary.push_back(from);
    for (int i = 0; i + 1 < edge.pieces; ++i)
      mesh.boundary.push_back(edge.first + (from == edge.a ? i : edge.pieces - 2 - i));
  }

  Cage rest_;
  const Mesh& mesh_;
  double tolerance_;
  bool is_piecewise_;
  double shortest_, error_ = 0;
  const PointValues& values_at_;
  size_t evaluations_ = 0;
  Points vertices_;
  std::vector<Value> values_;
  std::vector<Edge> edges_;
  std::unordered_map<std::uint64_t, int> edge_of_;
  std::vector<Piece> pieces_;
};

}  // namespace

FineMap fine_map(const Cage& rest, const Mesh& mesh, double tolerance, const PointValues& values_at,
                 bool is_piecewise) {
  return Cubics(rest, mesh, tolerance, is_piecewise, values_at).linear_pieces();
}

}  // namespace holomorph
