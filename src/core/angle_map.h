// Conformal maps by the angles of their boundary: f' = exp(i H), which vanishes nowhere, so that no
// such map folds (Weber, Gotsman 2010).
//
// exp(i H) is integrated along a tree of mesh edges, more finely towards the polygon's vertices,
// where it is a power.
#pragma once

#include "core/hilbert.h"
#include "core/mesh.h"

namespace holomorph {

class AngleMap {
 public:
  /// For a mesh of the polygon's inside, whose boundary runs through all of its vertices. Cost: a
  /// row of coordinates for each of about three places per mesh vertex.
  AngleMap(const Mesh& mesh, const HilbertCoordinates& coordinates);

  /// f at the mesh's vertices for theta, two boundary angles in radians for each corner, before and
  /// after it; f(anchor) = 0 and |f'(anchor)| = 1. The angle that remains at a corner, the inner
  /// one less theta's jump there, must be positive. Cost: a product of places x angles, an
  /// exponential and a sine for each place.
  void map(const VectorXd& theta, VectorXc& f) const;

  /// A vertex in the middle of the mesh.
  int anchor() const { return anchor_; }

 private:
  /// What is added from one mesh vertex to the next: weighted places.
  struct Step {
    int from, to;
    Index end;  ///< of its places; they start where those of the step before end
  };
  /// From a place without weight to the vertex of the polygon beside it.
  struct Tail {
    Index step, place;
    Complex way;
    int corner;  ///< -1: no corner
  };
  class Layout;

  int anchor_ = 0;
  Index vertices_ = 0;
  std::vector<Step> steps_;
  std::vector<Tail> tails_;
  std::vector<Complex> weights_;
  std::vector<double> angles_;  ///< inside, at each corner
  MatrixXd re_, im_;            ///< H at the places, Im H = 0 at the anchor
};

}  // namespace holomorph
