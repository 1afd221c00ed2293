// Edits of curved segments: tangents, smooth points and corners, degrees.
#pragma once

#include "edit/edits/edits.h"

namespace holomorph {

/// The control points next to a vertex; none on the side of a straight segment of degree 1. A
/// quadratic's one inner control point is the tangent of both its ends.
struct Tangents {
  std::optional<Handle> before, after;
};
Tangents tangents_of(const Scene& scene, Index vertex, Posture posture);

/// Whether both tangents of a vertex lie on one line through it.
bool is_smooth(const Scene& scene, Index vertex, Posture posture);

/// Puts a control point at a place. Opposite tangents of a smooth vertex turn along and keep their
/// lengths, unless `breaks`.
Scene tangent_moved(Scene scene, Handle tangent, Complex to, Posture posture, bool breaks);

/// With a smooth vertex: tangents along the line between its neighbours, a third of the way to
/// them. Straight neighbours become cubics.
Scene smoothed(Scene scene, Index vertex, Posture posture);
/// With a corner: tangents on the lines to the neighbours.
Scene cornered(Scene scene, Index vertex, Posture posture);
/// Smooth vertices of a selection become corners when all of them are smooth, else smooth.
Scene toggled_corners(Scene scene, const Selection& selection, Posture posture);

/// The segments that a selection means: of its control points, and after its vertices; all when
/// there are none.
std::set<Index> segments_of(const Scene& scene, const Selection& selection, Posture posture);

/// Degrees up by one (the curves stay, exactly) or down (least squares), within 1 to
/// kHighestDegree.
Scene raised(Scene scene, const Selection& selection, Posture posture);
Scene lowered(Scene scene, const Selection& selection, Posture posture);

}  // namespace holomorph
