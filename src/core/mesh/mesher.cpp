// Makes the domain mesh with CGAL's Delaunay refinement. No other file includes CGAL's mesher.
//
// Most vertices come from a graded triangular lattice. Inserting the whole lattice in one call is
// several times faster than refinement. Refinement then fills the gap between lattice and boundary.
//
// CGAL's assertions stay enabled in optimized builds (CGAL_DEBUG). Between edges that nearly touch,
// rounding may put midpoints on the wrong side, which breaks the mesher's invariants. The
// assertions turn this into an Error.
#include "core/mesh/mesher.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/geometry/deepest_point.h"

namespace holomorph {
namespace {

using Geometry = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex =
    CGAL::Triangulation_vertex_base_with_info_2<int, Geometry,
                                                CGAL::Delaunay_mesh_vertex_base_2<Geometry>>;
using Face = CGAL::Delaunay_mesh_face_base_2<Geometry>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Geometry, CGAL::Triangulation_data_structure_2<Vertex, Face>, CGAL::Exact_predicates_tag>;
using Point = Geometry::Point_2;

Point point_of(Complex z) {
  return {z.real(), z.imag()};
}
Complex complex_of(const Point& p) {
  return {p.x(), p.y()};
}

/// The target edge length at each point: by default `finest` at the boundary, growing to four times
/// `finest` inside. Distances to the boundary come from a grid; they are exact at the nodes of the
/// grid and interpolated in between.
class Sizing {
 public:
  explicit Sizing(PolygonView polygon) : box_(box_of(polygon.points())) {
    cell_ = std::max(box_.width(), box_.height()) / kNodes;
    columns_ = static_cast<int>(box_.width() / cell_) + 2;
    rows_ = static_cast<int>(box_.height() / cell_) + 2;
    distance_.resize(static_cast<size_t>(columns_) * rows_);
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c)
        distance_[static_cast<size_t>(r) * columns_ + c] = static_cast<float>(
            nearest_on_polygon(polygon, Complex(box_.left + c * cell_, box_.bottom + r * cell_))
                .distance);
  }

  void set_scale(double finest) { finest_ = finest; }
  double finest() const { return finest_; }
  /// Replaces the default by edge lengths that are given at points of the polygon, and makes them
  /// grow by no more than kSteepest times the way. The finest is the shortest of them.
  void set_lengths(PolygonView polygon, const std::function<double(Complex)>& length_at) {
    lengths_.resize(distance_.size());
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const Complex z(box_.left + c * cell_, box_.bottom + r * cell_);
        length(r, c) = static_cast<float>(
            length_at(encloses(polygon, z) ? z : nearest_on_polygon(polygon, z).point));
      }
    limit_growth();
    finest_ = *std::ranges::min_element(lengths_);
    for (float& each : lengths_) each /= static_cast<float>(finest_);
  }

  /// Whether the edge lengths were given. Small compared to the grid's cells, they need the exact
  /// distance from the outline.
  bool is_given() const { return !lengths_.empty(); }
  double distance(Complex z) const { return interpolated(distance_, z); }
  double size(Complex z) const {
    if (!lengths_.empty()) return finest_ * interpolated(lengths_, z);
    return std::min(finest_ + kGrading * distance(z), 4 * finest_);
  }
  /// The step of the lattice at z, in units of the finest edge length: the largest power of two, up
  /// to 16, that does not exceed size(z).
  int level(Complex z) const {
    const double h = size(z) / finest_;
    int level = 1;
    while (level < 16 && 2 * level <= h) level *= 2;
    return level;
  }

  /// The approximate number of vertices of the graded lattice: the integral of 1 / (area per
  /// vertex). The integral is computed as the mean of the integrand over the centers of cells,
  /// times the area of the polygon. A plain sum over cells would miss thin parts between the
  /// centers.
  double expected_vertices(PolygonView polygon) const {
    double mean = 1 / (0.866 * finest_ * finest_), sum = 0;
    int inside = 0;
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const Complex z(box_.left + (c + 0.5) * cell_, box_.bottom + (r + 0.5) * cell_);
        if (!encloses(polygon, z)) continue;
        const double h = level(z) * finest_;
        sum += 1 / (0.866 * h * h);
        ++inside;
      }
    if (inside > 0) mean = sum / inside;
    return mean * area_of(polygon) + 0.5 * perimeter(polygon) / finest_;
  }

  const Box& box() const { return box_; }

 private:
  static constexpr int kNodes = 48;
  static constexpr double kGrading = 0.08, kSteepest = 0.3;

  void limit_growth() {
    const float step = static_cast<float>(kSteepest * cell_);
    const auto limit = [&](int r, int c, int before_r, int before_c) {
      if (before_r >= 0 && before_r < rows_ && before_c >= 0 && before_c < columns_)
        length(r, c) = std::min(length(r, c), length(before_r, before_c) + step);
    };
    // Along rows and columns, two sweeps are enough.
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) limit(r, c, r - 1, c), limit(r, c, r, c - 1);
    for (int r = rows_ - 1; r >= 0; --r)
      for (int c = columns_ - 1; c >= 0; --c) limit(r, c, r + 1, c), limit(r, c, r, c + 1);
  }
  float& length(int row, int column) {
    return lengths_[static_cast<size_t>(row) * columns_ + column];
  }
  double interpolated(const std::vector<float>& values, Complex z) const {
    const double x = std::clamp((z.real() - box_.left) / cell_, 0.0, columns_ - 1.001);
    const double y = std::clamp((z.imag() - box_.bottom) / cell_, 0.0, rows_ - 1.001);
    const int c = static_cast<int>(x), r = static_cast<int>(y);
    const double u = x - c, v = y - r;
    const float* at = &values[static_cast<size_t>(r) * columns_ + c];
    return (1 - v) * ((1 - u) * at[0] + u * at[1]) +
           v * ((1 - u) * at[columns_] + u * at[columns_ + 1]);
  }

  Box box_;
  double cell_ = 1, finest_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<float> distance_, lengths_;
};

/// Refinement criteria: CGAL's angle bound, and the sizing at each triangle's center.
class Criteria : public CGAL::Delaunay_mesh_size_criteria_2<Triangulation> {
  using Base = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

 public:
  explicit Criteria(const Sizing& sizing) : Base(0.125, 0.0), sizing_(&sizing) {}

  class Is_bad : public Base::Is_bad {
   public:
    Is_bad(double aspect, const Sizing& sizing)
        : Base::Is_bad(aspect, 0.0, Geometry()), sizing_(&sizing) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality q) const {
      if (q.size() > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return q.sine() < this->B ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    CGAL::Mesh_2::Face_badness operator()(const Triangulation::Face_handle& face,
                                          Quality& q) const {
      const Complex a = complex_of(face->vertex(0)->point()),
                    b = complex_of(face->vertex(1)->point()),
                    c = complex_of(face->vertex(2)->point());
      double ab = std::norm(b - a), bc = std::norm(c - b), ca = std::norm(a - c);
      const double longest = std::max({ab, bc, ca}), shortest = std::min({ab, bc, ca});
      const double middle = ab + bc + ca - longest - shortest;
      const double h = kSlack * sizing_->size((a + b + c) / 3.0);
      q.second = longest / (h * h);  // Quality's size: too large if above 1
      const double area = cross(b - a, c - a);
      q.first = area * area / (longest * middle);  // squared sine of the smallest angle
      return operator()(q);
    }

   private:
    static constexpr double kSlack = 1.6;  // the lattice's own triangles must pass
    const Sizing* sizing_;
  };
  Is_bad is_bad_object() const { return Is_bad(this->bound(), *sizing_); }

 private:
  const Sizing* sizing_;
};

/// Points of a triangular lattice, without those too close to the boundary. Where the sizing
/// allows, the lattice is coarser by a power of two.
std::vector<Point> lattice(PolygonView polygon, const Sizing& sizing) {
  std::vector<Point> points;
  const double step = sizing.finest(), row_height = step * std::sqrt(0.75);
  const Box& box = sizing.box();
  const int rows = static_cast<int>(box.height() / row_height);
  std::vector<double> crossings;
  for (int r = 1; r <= rows; ++r) {
    const double y = box.bottom + r * row_height;
    crossings.clear();
    polygon.for_each_edge([&](Index, Complex a, Complex b) {
      if ((a.imag() <= y) != (b.imag() <= y))
        crossings.push_back(a.real() +
                            (y - a.imag()) / (b.imag() - a.imag()) * (b.real() - a.real()));
    });
    std::sort(crossings.begin(), crossings.end());
    for (size_t inside = 0; inside + 1 < crossings.size(); inside += 2) {
      const auto column = [&](double x) { return (x - box.left) / step - 0.5 * (r % 2); };
      const int last = static_cast<int>(std::floor(column(crossings[inside + 1])));
      for (int c = static_cast<int>(std::ceil(column(crossings[inside]))); c <= last; ++c) {
        const Complex z(box.left + (c + 0.5 * (r % 2)) * step, y);
        const int level = sizing.level(z);
        // The even rows and columns form a triangular lattice again.
        if (level > 1 &&
            (r % level != 0 || ((2 * c + r % 2) + (r / level % 2) * level) % (2 * level) != 0))
          continue;
        constexpr double kClearance = 0.7;  // from the outline, in units of the lattice's step
        if (sizing.distance(z) < kClearance * level * step) continue;
        if (sizing.is_given() &&
            nearest_on_polygon(polygon, z).distance < kClearance * level * step)
          continue;
        points.push_back(point_of(z));
      }
    }
  }
  return points;
}

/// The distance along a Hilbert curve of a 2^16 x 2^16 grid: points with close keys are close to
/// each other.
unsigned hilbert_key(unsigned x, unsigned y) {
  unsigned key = 0;
  for (unsigned s = 1u << 15; s > 0; s >>= 1) {
    const unsigned rx = (x & s) ? 1 : 0, ry = (y & s) ? 1 : 0;
    key += s * s * ((3 * rx) ^ ry);
    if (ry == 0) {
      if (rx == 1) x = 65535 - x, y = 65535 - y;
      std::swap(x, y);
    }
  }
  return key;
}

[[noreturn]] void nearly_touches_itself() {
  throw Error(ErrorKind::bad_input,
              "the rest cage nearly touches itself and cannot be meshed; move its points apart");
}

/// Copies the inside of the triangulation, with its vertices in Hilbert order. Throws Error if a
/// triangle has no area or if the outline is not closed.
Mesh extract(Triangulation& cdt, const std::vector<Triangulation::Vertex_handle>& corners,
             const Loops& loops) {
  std::vector<Triangulation::Vertex_handle> used;
  for (const auto& v : cdt.finite_vertex_handles()) v->info() = -1;
  for (const auto& face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    for (int k = 0; k < 3; ++k)
      if (face->vertex(k)->info() == -1) {
        face->vertex(k)->info() = 0;
        used.push_back(face->vertex(k));
      }
  }
  Box box;
  for (const auto& v : used) box.include(complex_of(v->point()));
  const double scale = 65535 / std::max({box.width(), box.height(), 1e-300});
  std::vector<std::pair<unsigned, size_t>> order;
  for (size_t i = 0; i < used.size(); ++i) {
    const Complex z = complex_of(used[i]->point());
    order.push_back({hilbert_key(static_cast<unsigned>((z.real() - box.left) * scale),
                                 static_cast<unsigned>((z.imag() - box.bottom) * scale)),
                     i});
  }
  std::sort(order.begin(), order.end());
  Mesh mesh;
  for (const auto& [key, i] : order) {
    used[i]->info() = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(complex_of(used[i]->point()));
  }
  std::vector<int> next(mesh.vertices.size(), -1);
  for (const auto& face : cdt.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const Triangle t = {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    if (cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
              mesh.vertices[t[2]] - mesh.vertices[t[0]]) <= 0)
      nearly_touches_itself();
    mesh.triangles.push_back(t);
    for (int k = 0; k < 3; ++k)
      if (!face->neighbor(k)->is_in_domain() || cdt.is_infinite(face->neighbor(k)))
        next[face->vertex((k + 1) % 3)->info()] = face->vertex((k + 2) % 3)->info();
  }
  std::sort(mesh.triangles.begin(), mesh.triangles.end(), [](const Triangle& a, const Triangle& b) {
    return *std::ranges::min_element(a) < *std::ranges::min_element(b);
  });
  for (const auto& corner : corners) mesh.cage_vertices.push_back(corner->info());
  for (Index l = 0; l < loops.count(); ++l) {
    if (l > 0) mesh.starts.push_back(static_cast<Index>(mesh.boundary.size()));
    const int first = mesh.cage_vertices[static_cast<size_t>(loops.first(l))];
    int v = first;
    do {
      mesh.boundary.push_back(v);
      v = next[v];
    } while (v >= 0 && v != first && mesh.boundary.size() <= mesh.vertices.size());
    if (v != first) nearly_touches_itself();
  }
  return mesh;
}

/// Moves the vertices that refinement put on the chords of a flattened cage onto the curves.
void settle_on(const Cage& cage, const FlatCage& flat, Mesh& mesh) {
  std::vector<int> corner(mesh.vertices.size(), -1);
  for (size_t i = 0; i < flat.points.size(); ++i)
    corner[mesh.cage_vertices[i]] = static_cast<int>(i);
  const Loops loops = PolygonView(flat).loops();
  Index last = -1;
  for (const int v : mesh.boundary) {
    if (corner[v] >= 0) {
      last = corner[v];
      continue;
    }
    // The mesh's boundary has the inside on its left, but the cage may run the other way. The chord
    // therefore runs from the last corner to either the next or the previous corner.
    const auto off = [&](Index other) {
      return nearest_on_segment(flat.points[last], flat.points[other], mesh.vertices[v]);
    };
    const Index next = loops.next(last), before = loops.before(last);
    const Index from = off(next).distance <= off(before).distance ? last : before;
    if (is_straight(cage, flat.locations[from].segment)) continue;
    const double fraction =
        nearest_on_segment(flat.points[from], flat.points[loops.next(from)], mesh.vertices[v]).t;
    mesh.vertices[v] = position_of(cage, flat.on_edge(from, fraction));
  }
}

/// Moves the inner vertices of triangles that settle_on inverted to the mean of their neighbors.
void untangle(Mesh& mesh) {
  const std::vector<char> outer = boundary_marks(mesh);
  constexpr int kMostRounds = 50;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<char> moves(mesh.vertices.size(), 0);
    bool any = false;
    for (const auto& [a, b, c] : mesh.triangles)
      if (cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]) <= 0)
        moves[a] = moves[b] = moves[c] = 1, any = true;
    if (!any) return;
    Points sum(mesh.vertices.size(), 0);
    std::vector<int> count(mesh.vertices.size(), 0);
    for (const auto& [a, b, c] : mesh.triangles)
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        sum[from] += mesh.vertices[to], ++count[from];
        sum[to] += mesh.vertices[from], ++count[to];
      }
    for (size_t v = 0; v < sum.size(); ++v)
      if (moves[v] && !outer[v]) mesh.vertices[v] = sum[v] / static_cast<double>(count[v]);
  }
}

/// The sizing that gives about as many vertices as wanted.
Sizing sizing_for(PolygonView polygon, double wanted) {
  Sizing sizing(polygon);
  double finest = std::sqrt(area_of(polygon) / wanted);
  // Ordinary polygons take a few steps. A needle takes more, because its finest edge length is
  // small compared with its perimeter.
  for (int step = 0; step < 60; ++step) {
    sizing.set_scale(finest);
    const double ratio = std::sqrt(sizing.expected_vertices(polygon) / wanted);
    finest *= std::clamp(ratio, 0.3, 3.0);
    if (std::abs(ratio - 1) < 0.05 && step >= 6) break;
  }
  sizing.set_scale(finest);
  return sizing;
}

/// Throws CGAL::Failure_exception if CGAL's invariants break, and Error if the mesh does not fill
/// the polygon. Refinement stops at three times the wanted number of vertices.
Mesh sized_mesh(PolygonView polygon, const Sizing& sizing, double wanted) {
  Triangulation cdt;
  std::vector<Triangulation::Vertex_handle> corners;
  for (const Complex& z : polygon.points()) corners.push_back(cdt.insert(point_of(z)));
  const Loops loops = polygon.loops();
  for (Index i = 0; i < polygon.size(); ++i) {
    const auto &from = corners[static_cast<size_t>(i)],
               &to = corners[static_cast<size_t>(loops.next(i))];
    check(from != to, "cage vertices are distinct");
    cdt.insert_constraint(from, to);
  }
  const std::vector<Point> inner = lattice(polygon, sizing);
  cdt.insert(inner.begin(), inner.end());

  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(cdt, Criteria(sizing));
  std::vector<Point> seeds;  // a point in each hole
  for (Index l = 1; l < loops.count(); ++l) {
    const auto hole = polygon.loop(l);
    seeds.push_back(point_of(deepest_point(Polyline({hole.begin(), hole.end()}, true))));
  }
  mesher.set_seeds(seeds.begin(), seeds.end());
  mesher.init();
  const size_t limit = static_cast<size_t>(3 * wanted) + 4 * polygon.points().size();
  size_t steps = 20 * limit;  // a step may also do nothing
  while (!mesher.is_refinement_done() && cdt.number_of_vertices() < limit && steps-- > 0)
    mesher.step_by_step_refine_mesh();
  Mesh mesh = extract(cdt, corners, loops);
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
  constexpr double kMissing = 1e-10;  // of the square of the polygon's size
  const double size = box_of(polygon.points()).diagonal();
  if (std::abs(area - area_of(polygon)) > kMissing * size * size) nearly_touches_itself();
  return mesh;
}

template <class Make>
Mesh without_cgal_errors(Make make) {
  // The exception has the details. The default handler would also print them.
  static const auto printing =
      CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
  static_cast<void>(printing);
  try {
    return make();
  } catch (const CGAL::Failure_exception&) {
    nearly_touches_itself();
  }
}

Mesh polygon_mesh(PolygonView polygon, const MeshOptions& options) {
  const double wanted = std::max(options.vertices, 16);
  return without_cgal_errors(
      [&] { return sized_mesh(polygon, sizing_for(polygon, wanted), wanted); });
}

/// The mesh of a cage from that of its flattened form.
Mesh settled(const Cage& cage, const FlatCage& flat, Mesh mesh) {
  if (flat.points.size() == static_cast<size_t>(cage.size())) return mesh;
  settle_on(cage, flat, mesh);
  untangle(mesh);
  std::vector<int> vertices;
  for (size_t i = 0; i < flat.points.size(); ++i)
    if (flat.locations[i].t == 0) vertices.push_back(mesh.cage_vertices[i]);
  mesh.cage_vertices = std::move(vertices);
  return mesh;
}

}  // namespace

Mesh domain_mesh(const Cage& cage, const MeshOptions& options) {
  check_rest_cage(cage);  // its messages name the cage's own segments
  if (!cage.parts.empty()) {
    constexpr double kLeast = 0.01;  // of all vertices
    const double area = area_of(flattened(cage));
    std::vector<Mesh> meshes;
    for (Index p = 0; p < cage.part_count(); ++p) {
      const Cage part = part_of(cage, p);
      const double share = std::max(kLeast, area_of(flattened(part)) / area);
      meshes.push_back(domain_mesh(part, {static_cast<int>(share * options.vertices)}));
    }
    return joined(meshes);
  }
  const FlatCage flat = flattened(cage);
  return settled(cage, flat, polygon_mesh(flat, options));
}

Mesh graded_mesh(const Cage& cage, const std::function<double(Complex)>& length_at, int most) {
  check_rest_cage(cage);
  check(cage.parts.empty(), "graded_mesh: one part");
  const FlatCage flat = flattened(cage);
  Sizing sizing(flat);
  sizing.set_lengths(flat, length_at);
  const double excess = sizing.expected_vertices(flat) / most;
  if (excess > 1) sizing.set_scale(sizing.finest() * std::sqrt(excess));
  return settled(cage, flat, without_cgal_errors([&] { return sized_mesh(flat, sizing, most); }));
}

Mesh domain_mesh(PolygonView polygon, const MeshOptions& options) {
  check_rest_cage(polygon_cage(polygon));
  return polygon_mesh(polygon, options);
}

}  // namespace holomorph
