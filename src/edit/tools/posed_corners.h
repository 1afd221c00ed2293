// The images of the cage's vertices and edges under the displayed map, and how to pick them.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// The controls of a corner, in window px: a ring that turns the corner, and two arms along its
/// edges that open it.
struct CornerMark {
  enum class Region { none, ring, before, after };
  Index vertex = 0;
  Complex center = 0;
  double radius = 0;              ///< the ring's radius
  Complex before = 0, after = 0;  ///< ends of the arms along the incoming and outgoing edge
  Region hovered = Region::none;
};

/// The image of a cage vertex under the displayed map; the posed vertex if no map is available yet.
Complex posed_vertex(const Workspace& workspace, Index vertex);

/// The controls of the corner at a cage vertex.
CornerMark corner_mark(const Workspace& workspace, Index vertex);
/// The part of a mark at a position in window px.
CornerMark::Region region_at(const CornerMark& mark, Complex px, double handle_px);

/// The cage vertex whose image is nearest within picking distance.
std::optional<Index> posed_vertex_at(const Workspace& workspace, Complex px);
/// The cage segment whose image is nearest within 0.8 of the picking distance.
std::optional<Index> posed_segment_at(const Workspace& workspace, Complex px);

/// The image of a segment as a polyline in the plane, from its start to its end.
Points posed_segment(const Workspace& workspace, Index segment);

}  // namespace holomorph
