// How stiff the picture is, painted with round brushes.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

/// One touch of the brush on the picture at rest.
struct BrushDab {
  Complex at;
  double radius = 1;  ///< pixels
  double level = 0;   ///< in its middle, powers of ten; falls off to 0 at the radius
  bool operator==(const BrushDab&) const = default;
};
inline constexpr double kLeastStiffness = -1, kMostStiffness = 2;  ///< powers of ten
inline constexpr double kLeastBrush = 1, kMostBrush = 1e5;         ///< radius, pixels
inline constexpr size_t kMostDabs = 5000;

/// The level at a place: the sum of all touches, each (1 - (d / r)^2)^2 of its own, kept within
/// bounds; 0 where nothing is painted. Stiffness is 10 to this power.
double stiffness_level(std::span<const BrushDab> dabs, Complex z);

}  // namespace holomorph
