// Pins for the parts of the picture that are far from a single pin.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// Points of the picture at rest that are far from these points, and from each other, by the
/// shortest way through the mesh. Each lies well inside of its part. The first is the farthest; the
/// others are at least 45 % as far from all points before them. At most `most`. Cost: one search of
/// the mesh per point.
Points far_points(const Mesh& mesh, std::span<const Complex> from, size_t most = 6);

/// Whether there is a single pin, which moves the whole picture, or a photograph of which nothing
/// is held yet.
bool can_hold_rest(const Workspace& workspace);
/// Sets pins at the far points, where they are displayed, in one step. In a photograph, holds what
/// is far from the pins instead (hold_beyond).
void hold_rest(Workspace& workspace);

}  // namespace holomorph
