// The stiffness of the picture, painted with round brushes.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

/// One dab of the brush on the rest picture.
struct BrushDab {
  Complex at;
  double radius = 1;  ///< pixels
  double level = 0;   ///< at the center, in powers of ten; falls to 0 at the radius
  bool operator==(const BrushDab&) const = default;
};
inline constexpr double kMinStiffness = -1, kMaxStiffness = 2;       ///< powers of ten
inline constexpr double kMinBrushRadius = 1, kMaxBrushRadius = 1e5;  ///< radius, pixels
inline constexpr size_t kMaxDabs = 5000;

/// The level at z: the sum of level (1 - (d / r)^2)^2 over all dabs, where d is the distance of z
/// from the center of the dab and r is the radius of the dab. The sum is clamped to [kMinStiffness,
/// kMaxStiffness] and is 0 where nothing is painted. The stiffness is 10 to this power.
double stiffness_level(std::span<const BrushDab> dabs, Complex z);

}  // namespace holomorph
