// Edits as functions from a deformation to a deformation. None of them knows about windows or
// tools.
#pragma once

#include <optional>
#include <set>

#include "core/mesh/mesh.h"
#include "scene/deformation.h"

namespace holomorph {

/// What can be picked: a control point of the cage (control 0 is a vertex), a pin or a stroke.
struct Handle {
  enum class Kind { cage, pin, stroke };
  Kind kind = Kind::cage;
  Index index = 0;  ///< segment, pin or stroke
  int control = 0;
  auto operator<=>(const Handle&) const = default;
};
using Selection = std::set<Handle>;

/// A control point that is no vertex.
inline bool is_tangent(const Handle& handle) {
  return handle.kind == Handle::Kind::cage && handle.control > 0;
}

/// Which of the two shapes an edit or a picture is about.
enum class EditMode { pose, rest };

/// The cage of a mode.
const Cage& cage_of(const Deformation& deformation, EditMode mode);
/// A handle's place in a mode; a stroke's is its middle.
Complex position_of(const Deformation& deformation, Handle handle, EditMode mode);
bool exists(const Deformation& deformation, Handle handle, EditMode mode);
/// Every handle of a mode: cage control points, then pins and strokes where the method uses
/// them.
std::vector<Handle> handles_of(const Deformation& deformation, EditMode mode);

/// The control points next to a vertex, which go with it; none for other handles.
std::vector<Handle> tangents_beside(const Cage& cage, Handle handle);
/// Moves one handle alone, a stroke as a whole; a moved rest point leaves the pose where it is.
void shift(Deformation& deformation, Handle handle, Complex by, EditMode mode);
/// Moves handles; moving a vertex takes the control points next to it along.
Deformation moved(Deformation deformation, const Selection& selection, Complex by, EditMode mode);

/// Puts one handle at a place.
Deformation placed(Deformation deformation, Handle handle, Complex at, EditMode mode);

/// The middle of the handles' box.
Complex center_of(const Deformation& deformation, const Selection& selection, EditMode mode);

/// A cage vertex inserted at parameter t of a segment, in rest and pose alike: both curves stay.
Deformation inserted(Deformation deformation, Index segment, double t);

/// Without these handles: vertices, pins and strokes. At least three segments stay: throws Error
/// otherwise.
Deformation erased(Deformation deformation, const Selection& selection, Refit refit = Refit::curve);

/// Whether a deformation's method, or the one that it follows, is the usual one for this use.
bool serves(const Deformation& deformation, MethodUse use);
/// With the usual method for a use.
Deformation with_method_for(Deformation deformation, MethodUse use);

/// With a pin more; the method becomes one that uses pins. In keyframes it is where these take its
/// place at rest, by number, or at its pose.
Deformation with_pin(Deformation deformation, Complex rest, Complex pose,
                     const std::vector<Points>& in_keyframes = {});

/// With a stroke more; the method becomes `strokes` unless it is, or follows that. In keyframes it
/// is where these take it from rest, by number, or in its pose.
Deformation with_stroke(Deformation deformation, Points rest, Points pose,
                        const std::vector<Points>& in_keyframes = {});
/// The points of a stroke.
const Points& curve_of(const Deformation& deformation, Index stroke, EditMode mode);
/// A stroke's mode redrawn, run through from the end that is nearer to its old start.
Deformation redrawn(Deformation deformation, Index stroke, Points curve, EditMode mode);
/// A curve pulled at one of its points: what is within `reach` of arc length, less than half of a
/// closed curve's, follows the less the farther it is.
Points pulled(const Points& curve, bool closed, size_t point, Complex by, double reach);
/// With another curve in place of a stroke's.
Deformation with_curve(Deformation deformation, Index stroke, Points curve, EditMode mode);
/// With an outline, and the method that takes the cage's shape onto it or follows that; the surface
/// is the one whose boundary it is.
Deformation with_outline(Deformation deformation, Points outline,
                         std::optional<SurfaceReference> surface = {});

/// A pin turned to an angle in radians; the pin turns the picture from then on.
Deformation turned(Deformation deformation, Index pin, double angle);

/// A pin's scale times a factor, kept within the bounds of PosePin; the pin turns and scales the
/// picture from then on.
Deformation scaled(Deformation deformation, Index pin, double factor);

/// The selected handles (all when none is) posed as they rest.
Deformation reset(Deformation deformation, const Selection& selection);

/// The cage posed as the deformation's pins would have its control points, in method `cage`; the
/// pins stay for later. Throws Error when they do not move the cage's own points (parameter
/// own_controls).
Deformation baked(Deformation deformation);

/// With method `bounded`, which follows the method that the deformation has now.
Deformation fold_free(Deformation deformation);

/// With another method, and the parameters that it had when it was left.
Deformation with_method(Deformation deformation, const std::string& id);
/// With a preset of its method, in place of the others.
Deformation with_preset(Deformation deformation, const Preset& preset);

/// The place on a mode's cage that is nearest to z.
struct CageHit {
  Index segment = 0;
  double t = 0;
  Complex point;
  double distance = 1e300;
};
CageHit nearest_on_cage(const Cage& cage, Complex z);

}  // namespace holomorph
