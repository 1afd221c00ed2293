// Motion between the maps of an elastic sheet.
#pragma once

#include "core/methods/proved_sheet.h"

namespace holomorph {

/// Rotations and sizes of triangles are blended, and the sheet relaxes from there, while its pins
/// follow the blended picture. `places` are those of the samples, and `numbers` the indices of the
/// pins that act, for messages. Cost: a sparse factorization.
std::shared_ptr<const ProvedMotion> sheet_motion(std::shared_ptr<const SheetSolver> solver,
                                                 std::vector<Location> places,
                                                 std::vector<size_t> numbers);

}  // namespace holomorph
