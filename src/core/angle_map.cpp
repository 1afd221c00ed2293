// A step's integral is a Gauss rule whose order grows as corners come nearer; into a corner, panels
// that shrink and the integral of the power that is left.
#include "core/angle_map.h"

#include <algorithm>

#include "core/antiderivative.h"
#include "core/arithmetic.h"
#include "core/outline_start.h"
#include "core/quadrature.h"

namespace holomorph {
namespace {

constexpr int kPanels = 6, kPanelNodes = 5;
constexpr double kRatio = 0.3;

/// Gauss nodes for a way whose length is so many times its distance from the nearest corner.
int nodes_for(double ratio) {
  return ratio < 0.25 ? 2 : ratio < 0.7 ? 3 : ratio < 2 ? 5 : 9;
}

int deepest_vertex(const Mesh& mesh, const Points& polygon) {
  const Complex middle = deepest_point(Polyline(polygon, true));
  const auto nearest =
      std::ranges::min_element(mesh.vertices, {}, [&](Complex z) { return std::norm(z - middle); });
  return static_cast<int>(nearest - mesh.vertices.begin());
}

}  // namespace

/// Lays places along the steps.
class AngleMap::Layout {
 public:
  Layout(AngleMap& map, const Mesh& mesh, const HilbertCoordinates& coordinates)
      : map_(map), mesh_(mesh), polygon_(coordinates.polygon()) {
    vertex_at_.assign(mesh.vertices.size(), -1);
    corner_of_.assign(polygon_.size(), -1);
    for (size_t j = 0; j < coordinates.corners().size(); ++j)
      corner_of_[static_cast<size_t>(coordinates.corners()[j])] = static_cast<int>(j);
    for (size_t i = 0; i < polygon_.size(); ++i)
      vertex_at_[static_cast<size_t>(mesh.cage_vertices[i])] = static_cast<int>(i);
  }

  void add(int from, int to) {
    const Complex a = mesh_.vertices[static_cast<size_t>(from)],
                  b = mesh_.vertices[static_cast<size_t>(to)], middle = 0.5 * (a + b);
    const int at_start = vertex_at_[static_cast<size_t>(from)],
              at_end = vertex_at_[static_cast<size_t>(to)];
    if (at_start < 0 && at_end < 0) {
      plain(a, b, nodes_for(std::abs(b - a) / nearest(a, b)), 1);
    } else if (at_start < 0) {
      graded(a, at_end, 1);
    } else if (at_end < 0) {
      graded(b, at_start, -1);
    } else {
      graded(middle, at_end, 1);
      graded(middle, at_start, -1);
    }
    map_.steps_.push_back({from, to, static_cast<Index>(points.size())});
  }

  Points points;

 private:
  void plain(Complex a, Complex b, int nodes, double sign) {
    const GaussRule& rule = gauss_rule(nodes);
    for (int g = 0; g < nodes; ++g) {
      points.push_back(a + rule.nodes[static_cast<size_t>(g)] * (b - a));
      map_.weights_.push_back(sign * rule.weights[static_cast<size_t>(g)] * (b - a));
    }
  }

  void graded(Complex a, int vertex, double sign) {
    const Complex corner = polygon_[static_cast<size_t>(vertex)];
    for (int panel = 0; panel < kPanels; ++panel) {
      const Complex b = corner + kRatio * (a - corner);
      plain(a, b, kPanelNodes, sign);
      a = b;
    }
    map_.tails_.push_back({static_cast<Index>(map_.steps_.size()),
                           static_cast<Index>(points.size()), sign * (corner - a),
                           corner_of_[static_cast<size_t>(vertex)]});
    points.push_back(a);
    map_.weights_.push_back(0);
  }

  double nearest(Complex a, Complex b) const {
    double least = INFINITY;
    for (const Complex& corner : polygon_)
      least = std::min(least, nearest_on_segment(a, b, corner).distance);
    return least;
  }

  AngleMap& map_;
  const Mesh& mesh_;
  const Points& polygon_;
  std::vector<int> vertex_at_;  ///< the polygon's vertex at a mesh vertex, or -1
  std::vector<int> corner_of_;
};

AngleMap::AngleMap(const Mesh& mesh, const HilbertCoordinates& coordinates)
    : vertices_(static_cast<Index>(mesh.vertices.size())) {
  check(mesh.cage_vertices.size() == coordinates.polygon().size(),
        "angle map: the mesh is one of the polygon");
  anchor_ = deepest_vertex(mesh, coordinates.polygon());
  const MeshTree tree(mesh, anchor_);
  Layout layout(*this, mesh, coordinates);
  for (const MeshTree::Edge& edge : tree.edges()) layout.add(edge.from, edge.to);
  for (size_t j = 0; j < coordinates.corners().size(); ++j) angles_.push_back(coordinates.angle(j));
  const MatrixXc h = coordinates.at(layout.points),
                 at_anchor = coordinates.at({&mesh.vertices[static_cast<size_t>(anchor_)], 1});
  re_ = h.real();
  im_ = h.imag().rowwise() - at_anchor.imag().row(0);
}

void AngleMap::map(const VectorXd& theta, VectorXc& f) const {
  const VectorXd turn = re_ * theta, shrink = im_ * theta;
  const auto slope = [&](Index place) { return std::polar(std::exp(-shrink[place]), turn[place]); };
  f.setZero(vertices_);
  Index place = 0;
  size_t tail = 0;
  for (size_t s = 0; s < steps_.size(); ++s) {
    Complex sum = 0;
    for (; place < steps_[s].end; ++place)
      sum += times(weights_[static_cast<size_t>(place)], slope(place));
    for (; tail < tails_.size() && tails_[tail].step == static_cast<Index>(s); ++tail) {
      const Tail& t = tails_[tail];
      // f' is a power of the distance there: its exponent is the jump, in angles.
      const double jump = t.corner < 0 ? 0 : theta[2 * t.corner + 1] - theta[2 * t.corner];
      const double exponent = t.corner < 0 ? 0 : -jump / angles_[static_cast<size_t>(t.corner)];
      sum += slope(t.place) * t.way / (1 + exponent);
    }
    f[steps_[s].to] = f[steps_[s].from] + sum;
  }
}

}  // namespace holomorph
