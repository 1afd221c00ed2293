// Selects the pins that a method can use if its maps are defined only inside the cage.
#pragma once

#include "core/maps/rest.h"

namespace holomorph {

struct UsablePins {
  std::vector<size_t> used;
  std::string note;  ///< names the pins outside the cage or at the position of an earlier pin
};
UsablePins usable_pins(const Rest& rest);

}  // namespace holomorph
