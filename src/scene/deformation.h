// The deformation of a layer: its handles with their rest and posed positions, the method, and the
// keyframes.
#pragma once

#include <optional>
#include <string>

#include "core/maps/method.h"
#include "core/mesh/flatten.h"
#include "core/mesh/surface.h"
#include "scene/limits.h"

namespace holomorph {

/// The text of a JSON object with all keys that this version does not know. Saving writes them
/// back.
using Extra = std::string;

/// A surface in space. Its flattened boundary is the outline. The outline alone says where the
/// surface lies, so moving and rotating it need no rules of their own. The path is relative to the
/// scene's folder in a scene file, and absolute in a loaded scene.
struct SurfaceReference {
  std::string file;
  Flattening flattening = Flattening::lscm;
  Extra extra = {};
  bool operator==(const SurfaceReference&) const = default;
};

/// A point handle. A pin with an angle also rotates and scales the picture around itself.
struct Pin {
  Complex rest, pose;
  std::optional<double> angle;
  Extra extra;
  double scale = 1;                   ///< has an effect only with an angle
  std::optional<double> turn = {};    ///< see PosePin::turn
  std::optional<double> radius = {};  ///< see RestPin::radius
  int depth = 0;                      ///< the picture near pins with greater depth is drawn on top
  int id = 0;                         ///< set where a layer is attached to the pin; else 0
  bool operator==(const Pin&) const = default;
};

/// A line on the picture and its target. Both run in the same direction.
struct Stroke {
  Points rest, pose;
  Extra extra;
  int id = 0;  ///< set where a layer is attached to the stroke; else 0
  bool operator==(const Stroke&) const = default;
};

/// A cage vertex at which the method `angles` sets the boundary angles. If no corners are listed,
/// all vertices are corners.
struct Corner {
  Index vertex = 0;
  PoseCorner pose = {};
  Extra extra = {};
  bool operator==(const Corner&) const = default;
};

/// The motion from a keyframe to the next one. Smooth motion starts and ends at rest, but does not
/// stop at keys between smooth intervals. Linear motion has constant speed. Hold keeps the pose
/// until the next key.
enum class Ease { smooth, linear, hold };

/// A pose at a given time.
struct Keyframe {
  double time = 0;  ///< seconds
  Pose pose = {};
  Ease ease = Ease::smooth;
  int turns = 0;  ///< whole turns since the previous key, in addition to the shortest rotation
  Extra pose_extra = {}, extra = {};
  bool operator==(const Keyframe&) const = default;
};

/// How a picture is deformed. The rest and posed cages have the same loops with the same numbers of
/// segments; both are empty until a cage is drawn. Scenes without a cage can be saved, too. Value
/// type.
struct Deformation {
  Cage rest, pose;
  std::vector<Pin> pins = {};
  std::vector<Stroke> strokes = {};
  Points outline = {};  ///< closed; the target shape of the cage for method `outline`
  std::optional<SurfaceReference> surface = {};
  std::vector<Corner> corners = {};        ///< sorted by vertex
  std::vector<BrushDab> stiffness = {};    ///< painted dabs, for methods that use them
  Frame frame = Frame::free;               ///< what the sides of the cage may do
  std::optional<double> held_beyond = {};  ///< Rest::held_beyond, at least kMinPinRadius
  /// Sorted by time. Keyframes whose poses do not fit the handles are kept but do not play.
  std::vector<Keyframe> keyframes = {};
  std::string method = usual_method(MethodUse::cage).id;
  Parameters parameters = {};
  /// The parameters of previously used methods, by method id.
  std::map<std::string, Parameters> other_parameters = {};
  Extra cage_extra = {}, method_extra = {};
  std::vector<Extra> loop_extras = {};  ///< one for each loop of the cage but the first, or none

  bool has_cage() const { return rest.size() > 0; }
  bool operator==(const Deformation&) const = default;
};

/// The pose of all handles, including those that the method does not use.
Pose whole_pose_of(const Deformation& deformation);
/// Whether a pose has the same holes and the same numbers of cage segments, pins, strokes and
/// corners as the deformation.
bool fits(const Deformation& deformation, const Pose& pose);
/// The deformation with this pose, which must fit the handles.
Deformation posed_as(Deformation deformation, const Pose& pose);

/// The rest state, without samples, from which the deformation's method does its precomputation.
/// Its segments have degrees high enough for all keyframes.
Rest rest_of(const Deformation& deformation, Precision precision);
/// The pose of the handles that the method uses.
Pose pose_of(const Deformation& deformation);
/// The deformation with all handles at rest.
Deformation at_rest(Deformation deformation);
/// The deformation with this cage and all handles at rest. The rest positions of pins and strokes
/// do not change.
Deformation with_cage(Deformation deformation, Cage cage);
Deformation with_cage(Deformation deformation, const Points& polygon);

}  // namespace holomorph
