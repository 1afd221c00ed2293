// Corners of the posed picture: what tool A picks, and those that are held at the least angle.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

/// All of the cage's vertices where the map takes them; the chosen one with its ring and arms.
void draw_corners(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style);
/// A mark at each corner that would fold if it were shut further.
void draw_limited_corners(ImDrawList& list, const Workspace& workspace, const OverlayStyle& style);

}  // namespace holomorph
