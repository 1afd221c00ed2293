// Pins that both of two keys hold at one position.
#pragma once

#include <cmath>

#include "core/types.h"

namespace holomorph {

/// Such a pin is still if it stays within this fraction of the size of the straight line from its
/// image in one key to its image in the other.
inline constexpr double kStillPin = 1e-4;

/// Whether the picture makes whole turns, because it was asked to turn by more than half a turn and
/// does so at the first such pin. It can then hold only one of them. Angles are in radians.
inline bool makes_whole_turns(double asked, double at_first) {
  return std::abs(asked) > kPi && std::abs(at_first) > kPi;
}

}  // namespace holomorph
