// An order of points in which neighbors in the list are neighbors in the plane.
#pragma once

#include <span>
#include <vector>

#include "core/types.h"

namespace holomorph {

/// The indices of points along a Z-order curve through a grid over their bounding box (Morton
/// 1966). A cell of a square box has at most about two points on average, while there are fewer
/// than two million. Points of a cell keep their order. Cost: linear.
std::vector<Index> nearby_order(std::span<const Complex> points);

/// Whether consecutive points are far apart: on average, several times the distance that evenly
/// spread points have from their neighbors. Fewer than 128 points never are.
bool are_scattered(std::span<const Complex> points);

}  // namespace holomorph
