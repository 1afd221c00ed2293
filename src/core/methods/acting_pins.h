// Which pins of a rest a method can use, for methods whose maps end at the cage.
#pragma once

#include "core/maps/deformer.h"

namespace holomorph {

struct ActingPins {
  std::vector<size_t> used;
  std::string note;  ///< names those that lie outside the cage or on the spot of an earlier one
};
ActingPins acting_pins(const Rest& rest);

}  // namespace holomorph
