// How far a pose rotates the boundary of a cage: the angles theta of Weber, Gotsman 2010.
#pragma once

#include "core/maps/rest.h"

namespace holomorph {

/// The smallest inner angle that a pose may leave at a corner. A corner that is sharper than this
/// at rest may not become sharper still.
inline constexpr double kLeastCornerAngle = 5 * kPi / 180;

struct BoundaryAngles {
  VectorXd theta;              ///< in radians, before and after each corner; no jumps of 2 pi
  std::vector<Index> limited;  ///< vertex indices of corners held at the smallest angle
};

/// The boundary angles that take `rest` to `pose`. Both cages must be counter-clockwise and have
/// the same segments; `corners` are vertices in increasing order. Each angle is the sum of an
/// edge's rotation, the corner's own angle, and the relaxation by tension (WG10, sec. 4). Nothing
/// depends on earlier poses, so a file needs no history. The jumps at corners are limited as
/// described for kLeastCornerAngle. If the turning number of the posed cage is not 1, an edge was
/// probably dragged across a vertex. Whole turns are then added at the sharpest vertices, which
/// keeps the angles continuous during the drag. Cost: linear.
BoundaryAngles boundary_angles(const Cage& rest, const Cage& pose,
                               const std::vector<Index>& corners,
                               const std::vector<PoseCorner>& own);

}  // namespace holomorph
