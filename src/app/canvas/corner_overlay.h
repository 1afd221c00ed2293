// Corners of the posed picture: those that the angle tool (A) edits, and those that are held at
// the smallest angle.
#pragma once

#include "app/canvas/overlay.h"

namespace holomorph {

/// Draws all vertices of the cage where the map takes them, and the ring and arms of the chosen
/// corner.
void draw_corners(ImDrawList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style);
/// Marks each corner that would fold if it were closed further.
void draw_limited_corners(ImDrawList& list, const Workspace& workspace, const OverlayStyle& style);

}  // namespace holomorph
