// Pins that both of two keys hold at one position.
#pragma once

#include <cmath>

#include "core/types.h"

namespace holomorph {

/// Such a pin is still if it stays within this fraction of the size of the straight line from its
/// image in one key to its image in the other.
inline constexpr double kStillPin = 1e-4;

/// Whether the picture makes whole turns, if it turns by this angle in radians at the first such
/// pin. It can then hold only one of them. An arm may turn farther without that.
inline bool makes_whole_turns(double rotation) {
  return std::abs(rotation) > kPi;
}

}  // namespace holomorph
