// Gauss rules on straight legs.
#include "core/angles/integration_paths.h"

#include <algorithm>
#include <limits>

#include "core/arithmetic.h"
#include "core/cauchy/quadrature.h"

namespace holomorph {
namespace {

constexpr int kPanels = 6, kMorePanels = 5, kPanelNodes = 5, kMoreNodes = 3;
constexpr double kRatio = 0.3;
/// In units of the shorter edge. Closer to a vertex than this, only the power matters.
constexpr double kPower = 1e-8;

/// The number of Gauss nodes for a leg, given the ratio of its length to its distance from the
/// nearest corner.
int nodes_for(double ratio) {
  return ratio < 0.25 ? 2 : ratio < 0.7 ? 3 : ratio < 2 ? 5 : 9;
}

}  // namespace

IntegrationPaths::Domain::Domain(const Mesh& its_mesh, const Cage& its_cage, Precision precision)
    : mesh(its_mesh),
      cage(its_cage),
      locator(its_mesh),
      inside(its_cage),
      corners(vertices_of(its_cage)),
      more_nodes(precision == Precision::full ? kMoreNodes : 0),
      panels(kPanels + (precision == Precision::full ? kMorePanels : 0)),
      corner_at(its_mesh.vertices.size(), -1),
      is_on_boundary(boundary_marks(its_mesh)) {
  for (const int node : mesh.cage_vertices) {
    const auto corner = std::ranges::find(corners, mesh.vertices[static_cast<size_t>(node)]);
    check(corner != corners.end(), "integration paths: the mesh belongs to the cage");
    corner_at[static_cast<size_t>(node)] = static_cast<int>(corner - corners.begin());
  }
}

IntegrationPaths::IntegrationPaths(const Mesh& mesh, const Cage& cage, Precision precision)
    : domain_(std::make_shared<const Domain>(mesh, cage, precision)) {}

IntegrationPaths::End IntegrationPaths::end_at(int node) const {
  if (node >= domain_->vertices())
    return {added_[static_cast<size_t>(node - domain_->vertices())], -1};
  const size_t vertex = static_cast<size_t>(node);
  return {domain_->mesh.vertices[vertex], domain_->corner_at[vertex]};
}

bool IntegrationPaths::may_be_on_boundary(int node) const {
  return node >= domain_->vertices() || domain_->is_on_boundary[static_cast<size_t>(node)] != 0;
}

void IntegrationPaths::add(int from, int to) {
  const End a = end_at(from), b = end_at(to);
  const bool may_leave =
      may_be_on_boundary(from) && may_be_on_boundary(to) && !is_straight(domain_->cage);
  if (!may_leave || !(add_inside({a, b}) || add_detour(a, b))) add_leg(a, b);
  steps_.push_back({from, to, static_cast<Index>(quadrature_points_.size())});
}

void IntegrationPaths::add_leg(const End& a, const End& b) {
  if (a.vertex < 0 && b.vertex < 0) {
    const double ratio = std::abs(b.at - a.at) / distance_to_corner(a.at, b.at);
    add_gauss_rule(a.at, b.at, nodes_for(ratio) + domain_->more_nodes, 1);
  } else if (a.vertex < 0) {
    add_graded_panels(a.at, b.vertex, 1);
  } else if (b.vertex < 0) {
    add_graded_panels(b.at, a.vertex, -1);
  } else {
    const Complex middle = 0.5 * (a.at + b.at);
    add_graded_panels(middle, b.vertex, 1);
    add_graded_panels(middle, a.vertex, -1);
  }
}

int IntegrationPaths::vertex_near(Complex z) const {
  const Mesh& mesh = domain_->mesh;
  const auto distance = [&](int node) {
    return std::norm(mesh.vertices[static_cast<size_t>(node)] - z);
  };
  if (const auto found = domain_->locator.at(z))
    return *std::ranges::min_element(mesh.triangles[static_cast<size_t>(found->triangle)], {},
                                     distance);
  return *std::ranges::min_element(mesh.boundary, {}, distance);
}

int IntegrationPaths::add_node(Complex z) {
  const int nearest = vertex_near(z);
  if (domain_->mesh.vertices[static_cast<size_t>(nearest)] == z) return nearest;
  added_.push_back(z);
  add(nearest, nodes() - 1);
  return nodes() - 1;
}

void IntegrationPaths::add_gauss_rule(Complex a, Complex b, int count, double sign) {
  const GaussRule& rule = gauss_rule(count);
  for (size_t g = 0; g < static_cast<size_t>(count); ++g) {
    quadrature_points_.push_back(a + rule.nodes[g] * (b - a));
    weights_.push_back(sign * rule.weights[g] * (b - a));
  }
}

void IntegrationPaths::add_graded_panels(Complex a, int vertex, double sign) {
  const Complex corner = domain_->corners[static_cast<size_t>(vertex)];
  // Closer than this distance, only the power matters, or rounding dominates.
  const size_t n = domain_->corners.size(), at = static_cast<size_t>(vertex);
  const double edge = std::min(std::abs(domain_->corners[(at + 1) % n] - corner),
                               std::abs(domain_->corners[(at + n - 1) % n] - corner)),
               rounding = std::numeric_limits<double>::epsilon() * std::abs(corner),
               least = std::max(kPower * edge, 1e4 * rounding);
  for (int panel = 0; panel < domain_->panels && std::abs(a - corner) > least; ++panel) {
    const Complex b = corner + kRatio * (a - corner);
    add_gauss_rule(a, b, kPanelNodes + domain_->more_nodes, sign);
    a = b;
  }
  tails_.push_back({static_cast<Index>(steps_.size()),
                    static_cast<Index>(quadrature_points_.size()), sign * (corner - a), vertex});
  quadrature_points_.push_back(a);
  weights_.push_back(0);
}

/// Adds a chain of legs and returns true if all their quadrature points are inside. Otherwise adds
/// nothing and returns false.
bool IntegrationPaths::add_inside(std::initializer_list<End> chain) {
  const size_t places = quadrature_points_.size(), tails = tails_.size();
  for (auto end = chain.begin() + 1; end != chain.end(); ++end) add_leg(end[-1], end[0]);
  const auto is_inside = [&](Complex z) { return domain_->inside.contains(z); };
  if (std::all_of(quadrature_points_.begin() + static_cast<Index>(places), quadrature_points_.end(),
                  is_inside))
    return true;
  quadrature_points_.resize(places);
  weights_.resize(places);
  tails_.resize(tails);
  return false;
}

// The chord of a curve that bends inward runs outside the cage, where the coordinates are different
// functions. Inside the cage, all paths between two nodes give the same integral.
bool IntegrationPaths::add_detour(const End& a, const End& b) {
  const Complex middle = 0.5 * (a.at + b.at), across = kI * (b.at - a.at);
  for (const double aside : {0.05, 0.15, 0.4, 0.8})
    for (const double sign : {1, -1})
      if (add_inside({a, {middle + sign * aside * across}, b})) return true;
  return false;
}

double IntegrationPaths::distance_to_corner(Complex a, Complex b) const {
  double least = INFINITY;
  for (const Complex& corner : domain_->corners)
    least = std::min(least, nearest_on_segment(a, b, corner).distance);
  return least;
}

void IntegrationPaths::integrate(const VectorXc& values, const VectorXd& exponents,
                                 VectorXc& integral) const {
  Index place = 0;
  size_t tail = 0;
  for (size_t s = 0; s < steps_.size(); ++s) {
    Complex sum = 0;
    for (; place < steps_[s].end; ++place)
      sum += times(weights_[static_cast<size_t>(place)], values[place]);
    for (; tail < tails_.size() && tails_[tail].step == static_cast<Index>(s); ++tail) {
      const Tail& t = tails_[tail];
      sum += values[t.point] * t.offset / (1 + exponents[t.vertex]);
    }
    integral[steps_[s].to] = integral[steps_[s].from] + sum;
  }
}

}  // namespace holomorph
