// Each dab has the falloff of soft selection, which is smooth and exactly 0 at the radius.
#include "core/geometry/stiffness.h"

#include <algorithm>

namespace holomorph {

double stiffness_level(std::span<const BrushDab> dabs, Complex z) {
  double level = 0;
  for (const BrushDab& dab : dabs)
    if (const double rest = 1 - std::norm(z - dab.at) / (dab.radius * dab.radius); rest > 0)
      level += dab.level * rest * rest;
  return std::clamp(level, kMinStiffness, kMaxStiffness);
}

}  // namespace holomorph
