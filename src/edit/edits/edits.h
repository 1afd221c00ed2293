// Edits are functions from deformations to deformations. They are independent of windows and tools.
#pragma once

#include <optional>
#include <set>

#include "scene/deformation.h"
#include "scene/prepared_map.h"

namespace holomorph {

/// Something that can be picked: a control point of the cage (control 0 is a vertex), a pin or a
/// stroke.
struct Handle {
  enum class Kind { cage, pin, stroke };
  Kind kind = Kind::cage;
  Index index = 0;  ///< segment, pin or stroke
  int control = 0;
  auto operator<=>(const Handle&) const = default;
};
using Selection = std::set<Handle>;

/// The word for these handles in the labels of history entries: "pin" or "stroke" if all are of
/// that kind, else "point".
std::string kind_of(const Selection& handles);

/// Whether a handle is a control point of the cage but not a vertex.
inline bool is_tangent(const Handle& handle) {
  return handle.kind == Handle::Kind::cage && handle.control > 0;
}

/// The shape that is edited or displayed: the pose, or the rest shape.
enum class EditMode { pose, rest };

/// The posed cage or the rest cage.
const Cage& cage_of(const Deformation& deformation, EditMode mode);
/// Whether the cage's points can be dragged: always at rest, and posed if they have an effect.
bool has_cage_handles(const Deformation& deformation, EditMode mode);
/// The position of a handle. For a stroke, its midpoint by arc length.
Complex position_of(const Deformation& deformation, Handle handle, EditMode mode);
/// Whether the handle's number is valid. Pins and strokes exist only if the method uses them.
bool exists(const Deformation& deformation, Handle handle, EditMode mode);
/// All handles that exist: the control points of the cage, then pins, then strokes.
std::vector<Handle> handles_of(const Deformation& deformation, EditMode mode);

/// The control points next to a vertex, which move with it; empty for other handles.
std::vector<Handle> adjacent_tangents(const Cage& cage, Handle handle);
/// Moves one handle, without the control points next to it. A stroke moves as a whole. See
/// rest_edits.h for what moving the rest shape does to the pose.
void shift(Deformation& deformation, Handle handle, Complex by, EditMode mode);
/// Moves handles. The control points next to a vertex move with it.
Deformation moved(Deformation deformation, const Selection& selection, Complex by, EditMode mode);

/// Moves one handle to a position.
Deformation placed(Deformation deformation, Handle handle, Complex at, EditMode mode);

/// The center of the bounding box of the handles' positions.
Complex center_of(const Deformation& deformation, const Selection& selection, EditMode mode);

/// Inserts a cage vertex at parameter t of a segment, in the rest shape, the pose and all keyframes
/// whose poses fit the deformation (see fits()). The curves keep their shapes.
Deformation inserted(Deformation deformation, Index segment, double t);

/// Deletes handles: vertices, pins and strokes. A hole or a part of which fewer than three vertices
/// would remain is deleted as a whole. Throws Error if no part would remain.
Deformation erased(Deformation deformation, const Selection& selection, Refit refit = Refit::curve);

/// Adds a pin. If the method does not use pins, switches to one that does. `in_keyframes` contains
/// the image of `rest` in each keyframe; the pin is placed there. If the list is empty, the pin is
/// at `pose` in all keyframes.
Deformation with_pin(Deformation deformation, Complex rest, Complex pose,
                     const std::vector<Points>& in_keyframes = {});

/// Adds a stroke. Switches to the method `strokes` unless the current method is `strokes` or
/// follows it. `in_keyframes` contains the image of `rest` in each keyframe. If the list is empty,
/// the stroke has the curve `pose` in all keyframes.
Deformation with_stroke(Deformation deformation, Points rest, Points pose,
                        const std::vector<Points>& in_keyframes = {});
/// The points of a stroke.
const Points& curve_of(const Deformation& deformation, Index stroke, EditMode mode);
/// Replaces a stroke's curve with a drawn curve. Reverses the drawn curve if that brings its ends
/// closer to the old ends.
Deformation redrawn(Deformation deformation, Index stroke, Points curve, EditMode mode);
/// Moves one point of a curve. Points within arc length `reach` of it follow, less the farther away
/// they are. For a closed curve, `reach` must be less than half its length.
Points pulled(const Points& curve, bool closed, size_t point, Complex by, double reach);
/// Replaces a stroke's curve.
Deformation with_curve(Deformation deformation, Index stroke, Points curve, EditMode mode);
/// Sets the outline, and the surface if the outline is the boundary of one. Switches to the usual
/// method for outlines unless the current method is that method or follows it.
Deformation with_outline(Deformation deformation, Points outline,
                         std::optional<SurfaceReference> surface = {});

/// Sets a pin's angle in radians. The pin then prescribes rotation and scale.
Deformation turned(Deformation deformation, Index pin, double angle);

/// Multiplies a pin's scale by a factor, clamped to the bounds of PosePin. The pin then prescribes
/// rotation and scale.
Deformation scaled(Deformation deformation, Index pin, double factor);
/// The radius of the disk that a pin holds, at rest. None if the pin's rotation is free or the
/// method holds no disks. The method of `prepared`, which may be null, chooses it for a pin that
/// has no radius of its own.
std::optional<double> held_radius(const Deformation& deformation, Index pin,
                                  const PreparedMap* prepared);
/// Sets the radius of the disk that a pin holds, within what its cage and files allow.
Deformation with_held_radius(Deformation deformation, Index pin, double radius);

/// Resets the pose of the selected handles to rest, or the whole pose if nothing is selected.
Deformation reset(Deformation deformation, const Selection& selection);

/// Poses the cage so that it reproduces the effect of the pins, and switches to the method `cage`.
/// The pins are kept. Throws Error unless the pins act on the cage's own control points (parameter
/// own_controls).
Deformation baked(Deformation deformation);

/// A point on a cage: the segment, its parameter t, and the distance to a given point.
struct CageHit {
  Index segment = 0;
  double t = 0;
  Complex point;
  double distance = 1e300;
};
/// The point of the cage that is nearest to z.
CageHit nearest_on_cage(const Cage& cage, Complex z);

}  // namespace holomorph
