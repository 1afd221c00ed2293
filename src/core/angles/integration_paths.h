// Ways through a mesh along which a function is integrated that is smooth but for powers at the
// vertices of a cage.
#pragma once

#include <initializer_list>

#include "core/maps/deformer.h"

namespace holomorph {

/// Nodes joined by steps; where on them the function is wanted, and with which weights. A step's
/// integral is a Gauss rule whose order grows as the cage's vertices come nearer; into a vertex,
/// panels that shrink and the integral of the power that is left.
class IntegrationPaths {
 public:
  /// The first nodes are the mesh's vertices. Mesh and cage must outlive the adding of steps.
  /// Precision::full takes nearly twice the places.
  IntegrationPaths(const Mesh& mesh, const Cage& cage, Precision precision);

  /// Goes from a node that has been reached to another one.
  void add(int from, int to);
  /// The mesh's vertex from which a place is reached.
  int vertex_near(Complex z) const;
  /// A node at any place of the mesh, reached from vertex_near; that itself if it is there.
  int add_node(Complex z);
  int nodes() const { return static_cast<int>(nodes_.size()); }

  /// Where the function is wanted: inside the cage or on it, never at its vertices.
  const Points& places() const { return places_; }

  /// The integral at the nodes, which holds its value where ways start. values[i] is the function
  /// at places()[i]; near vertex j it is a power of the distance with the exponent exponents[j],
  /// above -1.
  void integrate(const VectorXc& values, const VectorXd& exponents, VectorXc& integral) const;

 private:
  struct PathStep {
    int from, to;
    Index end;  ///< of its places; they start where those of the step before end
  };
  /// From a place without weight to the cage's vertex beside it.
  struct Tail {
    Index step, place;
    Complex way;
    int vertex;
  };

  /// Where a leg starts or ends: the cage's vertex there, or -1.
  struct End {
    Complex at;
    int vertex = -1;
  };

  void add_leg(const End& a, const End& b);
  bool add_inside(std::initializer_list<End> chain);
  bool add_detour(const End& a, const End& b);
  void plain(Complex a, Complex b, int count, double sign);
  void graded(Complex a, int vertex, double sign);
  double distance_to_corner(Complex a, Complex b) const;

  const Mesh* mesh_;
  const Cage* cage_;
  Points corners_, nodes_, places_;
  int more_nodes_, panels_;     ///< what Precision::full adds
  std::vector<int> vertex_at_;  ///< the cage's vertex at a node, or -1
  std::vector<char> on_boundary_;
  std::vector<PathStep> steps_;
  std::vector<Tail> tails_;
  std::vector<Complex> weights_;
};

}  // namespace holomorph
