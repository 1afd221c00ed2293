// Paths through a mesh along which functions are integrated. The functions are smooth except at the
// vertices of a cage, where they behave like powers of the distance.
#pragma once

#include <initializer_list>

#include "core/maps/deformer.h"

namespace holomorph {

/// Nodes joined by steps, with the quadrature points and weights of each step. A step is integrated
/// by a Gauss rule whose order is higher near the cage's vertices. A step that starts or ends at a
/// cage vertex is divided into panels that shrink toward the vertex. On the part next to the
/// vertex, a power is integrated exactly.
class IntegrationPaths {
 public:
  /// The first nodes are the mesh's vertices. Mesh and cage must stay alive while steps are added.
  /// Precision::full uses nearly twice as many quadrature points.
  IntegrationPaths(const Mesh& mesh, const Cage& cage, Precision precision);

  /// Adds a step from one node to another. `from` must be a starting node of the paths or the end
  /// of an earlier step.
  void add(int from, int to);
  /// The mesh vertex from which add_node reaches z.
  int vertex_near(Complex z) const;
  /// Adds a node at any point z in the mesh, with a step from vertex_near(z). Returns its index, or
  /// vertex_near(z) if that vertex is at z.
  int add_node(Complex z);
  int nodes() const { return static_cast<int>(nodes_.size()); }

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

  const Mesh* mesh_;
  const Cage* cage_;
  Points corners_, nodes_, quadrature_points_;
  int more_nodes_, panels_;     ///< larger with Precision::full
  std::vector<int> vertex_at_;  ///< the cage vertex at each node, or -1
  std::vector<char> on_boundary_;
  std::vector<PathStep> steps_;
  std::vector<Tail> tails_;
  std::vector<Complex> weights_;
};

}  // namespace holomorph
