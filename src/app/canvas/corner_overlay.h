// Marks on the posed picture: the corners that the angle tool (A) edits, and the corners that have
// reached the smallest angle.
#pragma once

#include "app/canvas/mark_list.h"
#include "app/canvas/overlay.h"

namespace holomorph {

/// Draws the images of the cage's edges and vertices under the map, and the ring and arms of the
/// chosen corner.
void draw_corners(MarkList& list, const Workspace& workspace, const ToolOverlay& gesture,
                  const OverlayStyle& style);
/// Marks each corner that would fold if it were closed further.
void draw_limited_corners(MarkList& list, const Workspace& workspace, const OverlayStyle& style);

}  // namespace holomorph
