// Edits to curved segments: their tangents, smooth vertices, corners and degrees.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// The control points on both sides of a vertex; none on a side where the segment has degree 1. The
/// inner control point of a quadratic segment is the tangent at both of its ends.
struct Tangents {
  std::optional<Handle> before, after;
};
Tangents tangents_of(const Deformation& deformation, Index vertex, EditMode mode);

/// Whether the two tangents of a vertex point in opposite directions, up to a small angle. This is
/// not stored, so nothing can contradict the tangents.
bool is_smooth(const Deformation& deformation, Index vertex, EditMode mode);

/// Moves a control point to a position. At a smooth vertex the opposite tangent rotates with it and
/// keeps its length, unless `breaks` is true.
Deformation tangent_moved(Deformation deformation, Handle tangent, Complex to, EditMode mode,
                          bool breaks);

/// Makes a vertex smooth: its tangents become parallel to the line between the neighboring
/// vertices. Each is a third as long as the distance to the neighbor on its side. Adjacent segments
/// of degree less than 3 become cubic.
Deformation smoothed(Deformation deformation, Index vertex, EditMode mode);
/// Makes a vertex a corner: its tangents point to the neighboring vertices.
Deformation cornered(Deformation deformation, Index vertex, EditMode mode);
/// Makes the selected vertices corners if all of them are smooth, else makes them smooth.
Deformation toggled_corners(Deformation deformation, const Selection& selection, EditMode mode);

/// The segments that a selection refers to: those that contain a selected control point or start at
/// a selected vertex. If there are none, returns all segments.
std::set<Index> segments_of(const Deformation& deformation, const Selection& selection,
                            EditMode mode);

/// Raises the degrees of the segments of a selection by one, up to kHighestDegree. The curves keep
/// their shapes exactly.
Deformation raised(Deformation deformation, const Selection& selection, EditMode mode);
/// Lowers the degrees of these segments by one, but not below 1, and fits the curves by least
/// squares.
Deformation lowered(Deformation deformation, const Selection& selection, EditMode mode);

}  // namespace holomorph
