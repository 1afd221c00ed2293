// The conformal or nearly conformal map that takes one shape's outline onto another one: iterative
// closest conformal maps (Segall, Ben-Chen 2016).
#pragma once

#include "core/cage.h"
#include "core/polyline.h"

namespace holomorph {

struct OutlineSettings {
  /// The published method: vertices at equal arc lengths, no smoothing, zeroth-order steps from an
  /// arc-length start. Otherwise: vertices where the conformal map of the insides needs them, which
  /// is the start, too, and steps of the first order.
  bool published = false;
  int vertices = 200;        ///< about so many along the outline, more when the cage has more
  double smoothness = 0.01;  ///< alpha_h: weight of mean |h^2 f''|^2
  double stiffness = 0;      ///< delta: weight of L^2 mean |f_zbar|^2; 0: f_zbar = 0
  double pin_weight = 0.1;   ///< beta
  /// How much turning the picture counts in the start, against mean squares of ln of the stretch.
  double upright = 1;
  int most_iterations = 30;
};

/// Shapes and places; all of them may be of either orientation.
struct OutlineTask {
  Cage source;
  Points outline;       ///< closed
  Points pins, pinned;  ///< at rest and wanted
};

/// f = C phi + conj(C) psi, with C over the basis; psi is empty for conformal maps.
struct OutlineMatch {
  Cage basis;  ///< the source cut into more segments
  VectorXc phi, psi;
  double rms = 0;        ///< of the source boundary's distances from the outline
  double hausdorff = 0;  ///< the largest distance either way
  /// Of f_z, inside a loop a fiftieth of each edge from the boundary (argument principle): the
  /// picture folds around each; the turning number is one more.
  int zeros = 0;
  int iterations = 0;
  std::vector<double>
      energies;            ///< after each iteration, the first one before any; in units of L^2
  double log_stretch = 0;  ///< of the start: how much the boundary must be stretched
};

/// Throws Error when the outline is open, crosses itself, encloses nothing or has less than three
/// points. Cost: for 200 vertices about 50 ms, and 5 ms an iteration.
OutlineMatch matched(const OutlineTask& task, const OutlineSettings& settings);

/// What `matched` would refuse an outline for.
void check_outline(std::span<const Complex> outline);

}  // namespace holomorph
