// By how much a pose turns the boundary of a cage: the angles theta of Weber, Gotsman 2010.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

/// The smallest angle that a corner is left with, unless it has less at rest.
inline constexpr double kLeastCornerAngle = 5 * kPi / 180;

struct BoundaryAngles {
  VectorXd theta;  ///< in radians, unwrapped along the boundary: before and after each corner
  std::vector<Index> limited;  ///< corners, by their vertices, that are held at the least angle
};

/// Between counter-clockwise cages with the same segments, at corners, which are vertices by
/// increasing number: how their edges turn, what each corner adds, what tensions take back (WG10,
/// sec. 4), limited so that kLeastCornerAngle remains. Where the posed cage turns around itself by
/// less or more than once, the vertices that are nearest to having been drawn over by an edge make
/// up for it, so that angles are continuous where an edge is drawn over another one. Cost: linear.
BoundaryAngles boundary_angles(const Cage& rest, const Cage& pose,
                               const std::vector<Index>& corners,
                               const std::vector<PoseCorner>& own);

}  // namespace holomorph
