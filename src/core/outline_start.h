// Where the points of one outline go on another one under the conformal map of their insides that
// stretches the boundary least: the start of outline matching.
//
// Both are mapped to the disk; what is left is one of the disk's own maps, with three parameters.
#pragma once

#include "core/polyline.h"

namespace holomorph {

/// The inner point that is farthest from a closed polyline, to rounding where one is.
Complex deepest_point(const Polyline& outline);

/// An increasing map from arc lengths of one closed curve to those of another one, one turn to one
/// turn.
struct Correspondence {
  std::vector<double> source, target;  ///< both increasing, the same number
  double source_length = 0, target_length = 0;
  double log_stretch = 0;  ///< root of what was minimised

  /// The target's arc length for one of the source's.
  double operator()(double length) const;
};

/// Minimises the mean square of ln of the relative stretch, plus `upright` times the square of the
/// angle by which the picture is turned: with 0, how the two stand does not matter. Both closed,
/// simple and counter-clockwise. Throws Error when an outline touches itself. Cost: about 30 ms.
Correspondence conformal_correspondence(const Polyline& source, const Polyline& target,
                                        double upright);

}  // namespace holomorph
