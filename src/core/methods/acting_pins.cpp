// Pins outside the cage, or on the spot of an earlier one, are left out and named.
#include "core/methods/acting_pins.h"

#include "core/cauchy/cauchy.h"

namespace holomorph {

ActingPins acting_pins(const Rest& rest) {
  constexpr double kSpread = 1e-9;  // pins nearer than this, in units of L, are one pin
  const double least = kSpread * perimeter(outline_of(rest.cage)) / (2 * kPi);
  ActingPins acting;
  std::string outside, doubled;
  for (size_t i = 0; i < rest.pins.size(); ++i) {
    const Complex z = rest.pins[i].position;
    const auto name = [&](std::string& list) {
      list += (list.empty() ? "" : ", ") + std::to_string(i + 1);
    };
    if (!is_finite(z) || !contains(rest.cage, z)) {
      name(outside);
      continue;
    }
    bool alone = true;
    for (const size_t other : acting.used)
      alone = alone && std::abs(rest.pins[other].position - z) > least;
    if (alone)
      acting.used.push_back(i);
    else
      name(doubled);
  }
  if (!outside.empty()) acting.note = "pin " + outside + " lies outside the cage and does not act";
  if (!doubled.empty())
    acting.note += (acting.note.empty() ? "" : "; ") +
                   ("pin " + doubled + " lies on another pin and does not act");
  return acting;
}

}  // namespace holomorph
