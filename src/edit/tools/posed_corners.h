// Where the cage's vertices and edges are in the posed picture, and what is picked at them.
#pragma once

#include "edit/workspace.h"

namespace holomorph {

/// A corner as it is drawn, in window px: a ring turns it, two arms along its edges open it.
struct CornerMark {
  enum class Region { none, ring, before, after };
  Index vertex = 0;
  Complex center = 0;
  double radius = 0;              ///< of the ring
  Complex before = 0, after = 0;  ///< the arms' ends, on the edges that end and start here
  Region hovered = Region::none;
};

/// Where the shown map takes a cage vertex; its posed place before there is one.
Complex posed_vertex(const Workspace& workspace, Index vertex);

CornerMark corner_mark(const Workspace& workspace, Index vertex);
/// What of a mark is at a place in window px.
CornerMark::Region part_at(const CornerMark& mark, Complex px, double handle_px);

/// The cage's vertex whose posed place is nearest within picking distance.
std::optional<Index> posed_vertex_at(const Workspace& workspace, Complex px);
/// The cage's segment whose image is there.
std::optional<Index> posed_segment_at(const Workspace& workspace, Complex px);

/// A segment's image as a polyline in the plane, from its start to its end.
Points posed_segment(const Workspace& workspace, Index segment);

}  // namespace holomorph
