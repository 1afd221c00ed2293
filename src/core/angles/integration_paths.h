// Paths through a mesh along which functions are integrated. The functions are smooth except at the
// vertices of a cage, where they behave like powers of the distance.
#pragma once

#include <initializer_list>

#include "core/cauchy/inside.h"
#include "core/maps/rest.h"
#include "core/mesh/locator.h"

namespace holomorph {

/// Nodes joined by steps, with the quadrature points and weights of each step. A step is integrated
/// by a Gauss rule whose order is higher near the cage's vertices. A step that starts or ends at a
/// cage vertex is divided into panels that shrink toward the vertex. On the part next to the
/// vertex, a power is integrated exactly.
class IntegrationPaths {
 public:
  /// The first nodes are the mesh's vertices. Mesh and cage must outlive the paths.
  /// Precision::full uses nearly twice as many quadrature points.
  IntegrationPaths(const Mesh& mesh, const Cage& cage, Precision precision);
  /// Paths without steps on the same mesh and cage, which are made quickly.
  IntegrationPaths without_steps() const { return IntegrationPaths(domain_); }

  /// Adds a step from one node to another. `from` must be a starting node of the paths or the end
  /// of an earlier step.
  void add(int from, int to);
  /// The mesh vertex from which add_node reaches z.
  int vertex_near(Complex z) const;
  /// Adds a node at any point z in the mesh, with a step from vertex_near(z). Returns its index, or
  /// vertex_near(z) if that vertex is at z.
  int add_node(Complex z);
  int nodes() const { return domain_->vertices() + static_cast<int>(added_.size()); }

  /// The quadrature points: inside the cage or on its boundary, never at its vertices.
  const Points& quadrature_points() const { return quadrature_points_; }

  /// Computes the integral at all nodes. On input, `integral` must hold the values at the nodes
  /// where the paths start. values[i] is the function at quadrature_points()[i]. Near vertex j the
  /// function is a power of the distance with the exponent exponents[j], which must be above -1.
  void integrate(const VectorXc& values, const VectorXd& exponents, VectorXc& integral) const;

 private:
  struct PathStep {
    int from, to;
    Index end;  ///< one past its last quadrature point; the first is the previous step's `end`
  };
  /// The part of a step next to a cage vertex. Its other end is a quadrature point of weight 0.
  struct Tail {
    Index step, point;
    Complex offset;
    int vertex;
  };

  /// The start or end of a leg, and the cage vertex at that point or -1.
  struct End {
    Complex at;
    int vertex = -1;
  };

  void add_leg(const End& a, const End& b);
  bool add_inside(std::initializer_list<End> chain);
  bool add_detour(const End& a, const End& b);
  void add_gauss_rule(Complex a, Complex b, int count, double sign);
  void add_graded_panels(Complex a, int vertex, double sign);
  double distance_to_corner(Complex a, Complex b) const;

  /// What does not depend on the steps.
  struct Domain {
    Domain(const Mesh& its_mesh, const Cage& its_cage, Precision precision);
    int vertices() const { return static_cast<int>(mesh.vertices.size()); }

    const Mesh& mesh;
    const Cage& cage;
    MeshLocator locator;
    Inside inside;
    Points corners;
    int more_nodes, panels;            ///< larger with Precision::full
    std::vector<int> corner_at;        ///< by vertex of the mesh: the cage vertex there, or -1
    std::vector<char> is_on_boundary;  ///< by vertex of the mesh
  };
  explicit IntegrationPaths(std::shared_ptr<const Domain> domain) : domain_(std::move(domain)) {}

  End end_at(int node) const;
  /// Whether a leg that starts or ends at a node may leave the cage. Added nodes count as well.
  bool may_be_on_boundary(int node) const;

  std::shared_ptr<const Domain> domain_;
  Points added_, quadrature_points_;
  std::vector<PathStep> steps_;
  std::vector<Tail> tails_;
  std::vector<Complex> weights_;
};

}  // namespace holomorph
