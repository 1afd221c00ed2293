// Plain implementations of other authors' projections onto maps of bounded distortion, for
// comparison.
//
// Each method minimizes the weighted sum of |T x - g|^2, where g is a reference, such that all
// elements satisfy sigma <= |f_z| - |f_zbar|, |f_z| + |f_zbar| <= Sigma and |f_zbar| <= k |f_z|.
// These constraints are not convex, and each method handles this differently.
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

/// The nearest element within the bounds: the moduli (|f_z|, |f_zbar|) are projected onto a
/// polygon, and the arguments are kept.
Element nearest_bounded(const Element& element, const Bounds& bounds);

/// Lipman 2012; with a harmonic T, Chen, Weber 2015. Each element has a frame, and Re(f_z / frame)
/// replaces |f_z| in the lower bounds, which makes them convex. A barrier method solves this
/// problem from a feasible start. All frames are 1 at first and are then set to f_z / |f_z|
/// repeatedly, until the elements stop changing. Every iterate satisfies the bounds. The barrier
/// needs an interior, so a k below 0.001 is raised to 0.001.
Projected by_local_frames(DerivativeOperator& t, const VectorXd& g,
                          const ProjectionSettings& settings);

/// Aigerman, Lipman 2013: each element that violates the bounds is projected, and the projection
/// defines a half-space. A quadratic program then finds the nearest map with all elements in their
/// half-spaces. These two steps repeat until all elements are within the bounds.
Projected by_half_spaces(DerivativeOperator& t, const VectorXd& start,
                         const ProjectionSettings& settings);

/// Kovalsky, Aigerman, Basri, Lipman 2015: all elements are projected. The next map is the nearest
/// one on the hyperplane through the projection, normal to the direction of projection. One
/// factorization serves all iterations.
Projected by_tangent_planes(DerivativeOperator& t, const VectorXd& start,
                            const ProjectionSettings& settings);

}  // namespace holomorph
