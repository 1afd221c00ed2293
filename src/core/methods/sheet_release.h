// What a sheet does when the pointer lets go of it.
#pragma once

#include "core/methods/sheet_solver.h"

namespace holomorph {

/// Turns of the pins, and the map to which they lead.
struct ReleasedSheet {
  Turns turns;
  SheetState state;
};

/// The turns of the last draft usually lead to its map. Where the map that they lead to, `found`,
/// is another one, other turns are tried: those of the draft once it is at rest, none, and those
/// with a pin turned once more or once less, left free, or alone. Returns the first ones that lead
/// to the draft, or else those that lead to the map nearest to it, if that is at most half as far
/// from it as `found`. Cost: up to 500 steps, and up to 18 final maps where the maps differ. Throws
/// Stopped.
std::optional<ReleasedSheet> released_sheet(const SheetSolver& solver,
                                            const SheetHandles::Target& target,
                                            const SheetState& draft, const SheetState& found,
                                            const std::stop_token& stop);

}  // namespace holomorph
