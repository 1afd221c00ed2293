// The maps of Chen, Weber 2017 (GPU-Accelerated Locally Injective Shape Deformation), for
// comparison with the puppet: f = Phi + conj(Psi) of least symmetric Dirichlet energy, with pins.
//
// f is linear in the unknowns, the coefficients of Phi and Psi in Cauchy coordinates. The energy is
// not convex in them. Each Newton step uses the positive part of the second derivative at each
// sample.
#pragma once

#include <stop_token>

#include "core/cauchy/boundary_basis.h"

namespace holomorph {

/// What is minimized: the weighted mean of the energy at the samples of a basis' boundary and,
/// with a penalty, the sum of the squared distances of pins from their targets.
struct HarmonicIsometricProblem {
  VectorXd weights;  ///< of the samples; their sum is 1
  Points pins, targets;
  double penalty = 1;
};

struct HarmonicIsometricMap {
  VectorXc phi, psi;  ///< coefficients
  double energy = 0;  ///< without the pins; 2 if rigid
  double total = 0;
  int iterations = 0;
  bool converged = false;
};

/// Minimizes from the best rotation of the pins. |f_z| > |f_zbar| holds at all samples throughout,
/// and f_z does not wind around 0 along the boundary, so it has no zeros inside. For domains
/// without holes. Throws Stopped on request. Cost of an iteration: 16 samples n^2 multiplications
/// for n polygon vertices, and a Cholesky factorization of size 4n.
HarmonicIsometricMap harmonic_isometric(const BoundaryBasis& basis,
                                        const HarmonicIsometricProblem& problem,
                                        int most_iterations = 500, std::stop_token stop = {});

}  // namespace holomorph
