// Edits as functions from a scene to a scene. None of them knows about windows or tools.
#pragma once

#include <optional>
#include <set>

#include "core/mesh/mesh.h"
#include "scene/scene.h"

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
enum class Posture { pose, rest };

/// The cage of a posture.
const Cage& cage_of(const Scene& scene, Posture posture);
/// A handle's place in a posture; a stroke's is its middle.
Complex position_of(const Scene& scene, Handle handle, Posture posture);
bool exists(const Scene& scene, Handle handle, Posture posture);
/// Every handle of a posture: cage control points, then pins and strokes where the method uses
/// them.
std::vector<Handle> handles_of(const Scene& scene, Posture posture);

/// The control points next to a vertex, which go with it; none for other handles.
std::vector<Handle> tangents_beside(const Cage& cage, Handle handle);
/// Moves one handle alone, a stroke as a whole; a moved rest point leaves the pose where it is.
void shift(Scene& scene, Handle handle, Complex by, Posture posture);
/// Moves handles; moving a vertex takes the control points next to it along.
Scene moved(Scene scene, const Selection& selection, Complex by, Posture posture);

/// Puts one handle at a place.
Scene placed(Scene scene, Handle handle, Complex at, Posture posture);

/// The middle of the handles' box.
Complex center_of(const Scene& scene, const Selection& selection, Posture posture);

/// A cage vertex inserted at parameter t of a segment, in rest and pose alike: both curves stay.
Scene inserted(Scene scene, Index segment, double t);

/// Without these handles: vertices, pins and strokes. At least three segments stay: throws Error
/// otherwise.
Scene erased(Scene scene, const Selection& selection, Refit refit = Refit::curve);

/// Whether a scene's map is this method's, or the one of `bounded` that follows it.
bool follows(const Scene& scene, const std::string& id);

/// With a pin more; the method becomes one that uses pins. In keyframes it is where these take its
/// place at rest, by number, or at its pose.
Scene with_pin(Scene scene, Complex rest, Complex pose,
               const std::vector<Points>& in_keyframes = {});

/// With a stroke more; the method becomes `strokes` unless it is, or follows that. In keyframes it
/// is where these take it from rest, by number, or in its pose.
Scene with_stroke(Scene scene, Points rest, Points pose,
                  const std::vector<Points>& in_keyframes = {});
/// The points of a stroke.
const Points& curve_of(const Scene& scene, Index stroke, Posture posture);
/// A stroke's posture redrawn, run through from the end that is nearer to its old start.
Scene redrawn(Scene scene, Index stroke, Points curve, Posture posture);
/// A curve pulled at one of its points: what is within `reach` of arc length, less than half of a
/// closed curve's, follows the less the farther it is.
Points pulled(const Points& curve, bool closed, size_t point, Complex by, double reach);
/// With another curve in place of a stroke's.
Scene with_curve(Scene scene, Index stroke, Points curve, Posture posture);
/// With an outline, and the method that takes the cage's shape onto it or follows that; the surface
/// is the one whose boundary it is.
Scene with_outline(Scene scene, Points outline, std::optional<SurfaceReference> surface = {});

/// A pin turned to an angle in radians; the pin turns the picture from then on.
Scene turned(Scene scene, Index pin, double angle);

/// A pin's scale times a factor, kept within the bounds of PosePin; the pin turns and scales the
/// picture from then on.
Scene scaled(Scene scene, Index pin, double factor);

/// The selected handles (all when none is) posed as they rest.
Scene reset(Scene scene, const Selection& selection);

/// The cage posed as the scene's pins would have its control points, in method `cage`; the pins
/// stay for later. Throws Error when they do not move the cage's own points (parameter
/// own_controls).
Scene baked(Scene scene);

/// With method `bounded`, which follows the method that the scene has now.
Scene fold_free(Scene scene);

/// With another method, and the parameters that it had when it was left.
Scene with_method(Scene scene, const std::string& id);
/// With a preset of its method, in place of the others.
Scene with_preset(Scene scene, const Preset& preset);

/// The place on a posture's cage that is nearest to z.
struct CageHit {
  Index segment = 0;
  double t = 0;
  Complex point;
  double distance = 1e300;
};
CageHit nearest_on_cage(const Cage& cage, Complex z);

}  // namespace holomorph
