// How far a pose rotates the boundary of a cage: the angles theta of Weber, Gotsman 2010.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// The smallest angle that a pose leaves at a corner whose angle at rest is not smaller.
inline constexpr double kLeastCornerAngle = 5 * kPi / 180;

struct BoundaryAngles {
  VectorXd theta;  ///< in radians, unwrapped along the boundary: before and after each corner
  std::vector<Index> limited;  ///< vertex numbers of corners held at the smallest angle
};

/// The boundary angles that take `rest` to `pose`. Both cages must be counter-clockwise and have
/// the same segments; `corners` are vertices in increasing order. The angles are the sum of the
/// rotations of the edges, each corner's own angles, and the relaxation by tension (WG10, sec. 4).
/// They are limited so that kLeastCornerAngle remains at every corner. Where the turning number of
/// the posed cage is not 1, whole turns are added at its sharpest vertices, where an edge was most
/// likely dragged across a vertex; this keeps the angles continuous during such a drag. Cost:
/// linear.
BoundaryAngles boundary_angles(const Cage& rest, const Cage& pose,
                               const std::vector<Index>& corners,
                               const std::vector<PoseCorner>& own);

}  // namespace holomorph
