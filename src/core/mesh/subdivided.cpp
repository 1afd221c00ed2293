#include "core/mesh/subdivided.h"

#include <algorithm>
#include <map>

#include "core/geometry/nearby_order.h"

namespace holomorph {

namespace {

/// Finds or adds the vertices of the finer mesh.
class Subdivider {
 public:
  Subdivider(const Mesh& mesh, int pieces)
      : mesh_(mesh), pieces_(pieces), vertices_(mesh.vertices) {}

  /// The vertex after `step` of the pieces of the edge from a to b.
  int on_edge(int a, int b, int step) {
    if (step == 0) return a;
    if (step == pieces_) return b;
    if (a > b) std::swap(a, b), step = pieces_ - step;
    const auto [found, is_new] =
        first_on_edge_.try_emplace({a, b}, static_cast<int>(vertices_.size()));
    if (is_new)
      for (int i = 1; i < pieces_; ++i)
        add(at(a) + static_cast<double>(i) / pieces_ * (at(b) - at(a)));
    return found->second + step - 1;
  }

  std::vector<Triangle> pieces_of(const Triangle& t) {
    const int a = t[0], b = t[1], c = t[2];
    std::vector<Triangle> triangles;
    // Row i goes from the edge ab to the edge ac, i pieces away from a.
    std::vector<int> before{a}, row;
    for (int i = 1; i <= pieces_; ++i) {
      const auto inside = [&](int j) {
        add((static_cast<double>(pieces_ - i) * at(a) + static_cast<double>(i - j) * at(b) +
             static_cast<double>(j) * at(c)) /
            static_cast<double>(pieces_));
        return static_cast<int>(vertices_.size()) - 1;
      };
      row.clear();
      for (int j = 0; j <= i; ++j)
        row.push_back(i == pieces_ ? on_edge(b, c, j)
                      : j == 0     ? on_edge(a, b, i)
                      : j == i     ? on_edge(a, c, i)
                                   : inside(j));
      for (size_t j = 0; j < before.size(); ++j) {
        triangles.push_back({before[j], row[j], row[j + 1]});
        if (j > 0) triangles.push_back({before[j - 1], row[j], before[j]});
      }
      before = row;
    }
    return triangles;
  }

  const Points& vertices() const { return vertices_; }

 private:
  Complex at(int v) const { return mesh_.vertices[static_cast<size_t>(v)]; }
  void add(Complex z) { vertices_.push_back(z); }

  const Mesh& mesh_;
  int pieces_;
  Points vertices_;
  std::map<std::pair<int, int>, int> first_on_edge_;
};

}  // namespace

Mesh subdivided(const Mesh& mesh, int pieces) {
  if (pieces <= 1) return mesh;
  Mesh out;
  Subdivider subdivider(mesh, pieces);
  for (const Triangle& t : mesh.triangles) {
    const std::vector<Triangle> pieces_of_it = subdivider.pieces_of(t);
    out.triangles.insert(out.triangles.end(), pieces_of_it.begin(), pieces_of_it.end());
  }
  const Loops loops = mesh.boundary_loops();
  for (Index l = 0; l < loops.count(); ++l) {
    if (l > 0) out.starts.push_back(static_cast<Index>(out.boundary.size()));
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      for (int step = 0; step < pieces; ++step)
        out.boundary.push_back(subdivider.on_edge(mesh.boundary[static_cast<size_t>(i)],
                                                  mesh.boundary[static_cast<size_t>(loops.next(i))],
                                                  step));
  }
  out.cage_vertices = mesh.cage_vertices;

  const std::vector<Index> order = nearby_order(subdivider.vertices());
  std::vector<int> number(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    number[static_cast<size_t>(order[i])] = static_cast<int>(i);
    out.vertices.push_back(subdivider.vertices()[static_cast<size_t>(order[i])]);
  }
  const auto renumber = [&](int& v) { v = number[static_cast<size_t>(v)]; };
  for (Triangle& t : out.triangles) std::ranges::for_each(t, renumber);
  std::ranges::for_each(out.boundary, renumber);
  std::ranges::for_each(out.cage_vertices, renumber);
  return out;
}

}  // namespace holomorph
