// Pins outside the cage or at the position of an earlier pin are left out and named in the note.
#include "core/maps/acting_pins.h"

#include "core/cauchy/cauchy.h"

namespace holomorph {

namespace {

/// Whether a point outside the cage has the outline of a part around it.
bool is_in_hole(const Cage& cage, Complex z) {
  for (Index part = 0; part < cage.part_count(); ++part)
    if (winding_number(outline_of(loop_of(cage, loops_of_part(cage, part).first)).points, z) != 0)
      return true;
  return false;
}

}  // namespace

UsablePins usable_pins(const Rest& rest) {
  constexpr double kSpread = 1e-9;  // pins closer together than this, in units of L, count as one
  const double least = kSpread * perimeter(outline_of(rest.cage)) / (2 * kPi);
  UsablePins acting;
  std::string outside, in_holes, doubled;
  for (size_t i = 0; i < rest.pins.size(); ++i) {
    const Complex z = rest.pins[i].position;
    const auto name = [&](std::string& list) {
      list += (list.empty() ? "" : ", ") + std::to_string(i + 1);
    };
    if (!is_finite(z) || !contains(rest.cage, z)) {
      const bool in_hole = is_finite(z) && rest.cage.has_holes() && is_in_hole(rest.cage, z);
      name(in_hole ? in_holes : outside);
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
  const auto add = [&](const std::string& list, const char* why) {
    if (list.empty()) return;
    acting.note += (acting.note.empty() ? "Ignored: pin " : ". Ignored: pin ") + list + why;
  };
  add(outside, " (outside the cage)");
  add(in_holes, " (in a hole)");
  add(doubled, " (on another pin)");
  return acting;
}

}  // namespace holomorph
