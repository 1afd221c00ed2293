// Makes maps without folds single-valued in a domain with holes.
//
// The map is the integral of its derivatives. Around a hole, this integral must vanish.
#pragma once

#include "core/bounded/tree_integrals.h"
#include "core/mesh/hole_loops.h"

namespace holomorph {

class HoleClosing {
 public:
  /// Both arguments must outlive this object. Cost: that of HoleLoops and TreeIntegrals.
  HoleClosing(const BoundaryBasis& basis, const Mesh& mesh);

  bool has_holes() const { return !loops_.paths().empty(); }
  /// The paths to which gaps belong.
  const HoleLoops& loops() const { return loops_; }
  /// The integral of df along each path.
  VectorXc gaps(const LogMap& map) const;
  /// The map, changed as little as possible so that there are no gaps. A conformal map stays
  /// conformal. The change is measured by the mean squares of l and of nu or Psi' on the boundary.
  /// Method: Newton's, which may fail for large gaps: see is_closed.
  LogMap closed(LogMap map, bool conformal) const;
  /// Whether no gap exceeds 1e-6 of the domain's diagonal.
  bool is_closed(const LogMap& map) const;

 private:
  /// The weighted values of Phi' and Psi' at the nodes.
  Derivatives weighted(const LogMap& map) const;

  const BoundaryBasis& basis_;
  HoleLoops loops_;
  TreeIntegrals integrals_;
};

}  // namespace holomorph
