// Edits of curved segments: tangents, smooth points and corners, degrees.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// The control points next to a vertex; none on the side of a straight segment of degree 1. A
/// quadratic's one inner control point is the tangent of both its ends.
struct Tangents {
  std::optional<Handle> before, after;
};
Tangents tangents_of(const Deformation& deformation, Index vertex, EditMode mode);

/// Whether both tangents of a vertex lie on one line through it.
bool is_smooth(const Deformation& deformation, Index vertex, EditMode mode);

/// Puts a control point at a place. Opposite tangents of a smooth vertex turn along and keep their
/// lengths, unless `breaks`.
Deformation tangent_moved(Deformation deformation, Handle tangent, Complex to, EditMode mode,
                          bool breaks);

/// With a smooth vertex: tangents along the line between its neighbours, a third of the way to
/// them. Straight neighbours become cubics.
Deformation smoothed(Deformation deformation, Index vertex, EditMode mode);
/// With a corner: tangents on the lines to the neighbours.
Deformation cornered(Deformation deformation, Index vertex, EditMode mode);
/// Smooth vertices of a selection become corners when all of them are smooth, else smooth.
Deformation toggled_corners(Deformation deformation, const Selection& selection, EditMode mode);

/// The segments that a selection means: of its control points, and after its vertices; all when
/// there are none.
std::set<Index> segments_of(const Deformation& deformation, const Selection& selection,
                            EditMode mode);

/// Degrees up by one (the curves stay, exactly) or down (least squares), within 1 to
/// kHighestDegree.
Deformation raised(Deformation deformation, const Selection& selection, EditMode mode);
Deformation lowered(Deformation deformation, const Selection& selection, EditMode mode);

}  // namespace holomorph
