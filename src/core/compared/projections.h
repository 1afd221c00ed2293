// Other people's projections onto maps of bounded distortion, for comparison: plain ones.
//
// All look for the x near a reference, min sum of weights |T x - g|^2, whose elements keep
// sigma <= |f_z| - |f_zbar|, |f_z| + |f_zbar| <= Sigma and |f_zbar| <= k |f_z|. That set is not
// convex; each has its own way around that.
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

/// What came out, after how many outer steps, and whether it stopped moving.
struct Projected {
  VectorXd x;
  int iterations = 0;
  bool settled = false;
};

/// The nearest element within the bounds: moduli on the nearest point of a polygon.
Element nearest_bounded(const Element& element, const Bounds& bounds);

/// Lipman 2012, and Chen, Weber 2015 when T is harmonic: with a frame for each element, Re(f_z /
/// frame) instead of |f_z| bounds from below, which is convex; solved by a barrier from a feasible
/// start. Frames start as the identity's and then follow f_z, until nothing moves. Each iterate
/// keeps the bounds, with k = 0.001 for smaller ones: a barrier needs room.
Projected by_local_frames(DerivativeOperator& t, const VectorXd& g,
                          const ProjectionSettings& settings);

/// Aigerman, Lipman 2013: the map goes to the nearest one whose elements lie in the half-spaces
/// behind the projections of those that break the bounds, a quadratic program; then again.
Projected by_half_spaces(DerivativeOperator& t, const VectorXd& start,
                         const ProjectionSettings& settings);

/// Kovalsky, Aigerman, Basri, Lipman 2015: all elements are projected, and the map goes to the
/// nearest one on the plane through them that is normal to the way there. One factorisation.
Projected by_tangent_planes(DerivativeOperator& t, const VectorXd& start,
                            const ProjectionSettings& settings);

}  // namespace holomorph
