// Plain implementations of other authors' projections onto maps of bounded distortion, for
// comparison.
//
// Each looks for the x nearest to a reference, min sum of weights |T x - g|^2, such that all
// elements satisfy sigma <= |f_z| - |f_zbar|, |f_z| + |f_zbar| <= Sigma and |f_zbar| <= k |f_z|.
// This set is not convex, and the methods deal with that in different ways.
#pragma once

#include <stop_token>

#include "core/bounded/certificate.h"
#include "core/compared/derivative_operator.h"

namespace holomorph {

/// The bounds, and a way to end the work early.
struct ProjectionSettings {
  Bounds bounds;
  std::stop_token stop = {};
};

/// The result, the number of outer iterations, and whether they converged.
struct Projected {
  VectorXd x;
  int iterations = 0;
  bool settled = false;
};

/// The nearest element within the bounds: its moduli (|f_z|, |f_zbar|) are projected onto a polygon
/// and its arguments are kept.
Element nearest_bounded(const Element& element, const Bounds& bounds);

/// Lipman 2012; with a harmonic T, Chen, Weber 2015. Each element has a frame, and Re(f_z / frame)
/// replaces |f_z| in the lower bounds, which makes them convex. A barrier method solves this
/// problem from a feasible start. The frames start as those of the identity and then follow f_z,
/// until the elements stop changing. Every iterate satisfies the bounds, except that k is at least
/// 0.001, because the barrier needs an interior.
Projected by_local_frames(DerivativeOperator& t, const VectorXd& g,
                          const ProjectionSettings& settings);

/// Aigerman, Lipman 2013: each element that breaks the bounds is projected, and the projection
/// defines a half-space. The map moves to the nearest one with all elements in their half-spaces,
/// which is a quadratic program. This repeats until all elements are within the bounds.
Projected by_half_spaces(DerivativeOperator& t, const VectorXd& start,
                         const ProjectionSettings& settings);

/// Kovalsky, Aigerman, Basri, Lipman 2015: all elements are projected, and the map moves to the
/// nearest one on the hyperplane through the projection that is normal to the projection's
/// direction. One factorization serves all iterations.
Projected by_tangent_planes(DerivativeOperator& t, const VectorXd& start,
                            const ProjectionSettings& settings);

}  // namespace holomorph
