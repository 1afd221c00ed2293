// What a sheet does when the pointer lets go of it.
#pragma once

#include "core/methods/sheet_solver.h"

namespace holomorph {

/// Turns of the pins, and the map to which they lead.
struct ReleasedSheet {
  Turns turns;
  SheetState state;
};

/// The turns of the last draft usually lead to its map. Where they lead elsewhere, to `final`,
/// others are tried: none, those with a pin turned once more or less, and those with a pin left
/// free or alone. Returns those that lead to the draft, or else much nearer to it. None if there
/// are none. Cost: a draft, or up to 17 final maps if the two differ. Throws Stopped.
std::optional<ReleasedSheet> released_sheet(const SheetSolver& solver,
                                            const SheetHandles::Target& target,
                                            const SheetState& draft, const SheetState& final,
                                            const std::stop_token& stop);

}  // namespace holomorph
