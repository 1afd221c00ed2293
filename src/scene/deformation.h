// What methods and tools know of a layer: handles at rest and posed, the method, keyframes.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/maps/deformer.h"
#include "core/mesh/flatten.h"
#include "core/mesh/surface.h"

namespace holomorph {

/// JSON object text of keys that this version does not know; they are kept and written back.
using Extra = std::string;

/// A surface in space whose flat boundary is the outline. In a file the path is relative to the
/// scene's folder, in a loaded scene absolute.
struct SurfaceReference {
  std::string file;
  Flattening flattening = Flattening::lscm;
  Extra extra = {};
  bool operator==(const SurfaceReference&) const = default;
};

/// A point handle; with an angle it turns and scales the picture around it, too.
struct Pin {
  Complex rest, pose;
  std::optional<double> angle;
  Extra extra;
  double scale = 1;  ///< acts with an angle only
  int depth = 0;     ///< what lies around a higher one is drawn over the rest
  bool operator==(const Pin&) const = default;
};

/// A line on the picture and where it goes; both run the same way.
struct Stroke {
  Points rest, pose;
  Extra extra;
  bool operator==(const Stroke&) const = default;
};

/// A vertex of the cage whose angles method `angles` sets. Without any, all vertices are corners.
struct Corner {
  Index vertex = 0;
  PoseCorner pose = {};
  Extra extra = {};
  bool operator==(const Corner&) const = default;
};

/// How a keyframe goes on to the next one: smooth ones pass their keys without a stop and rest at
/// both ends, linear ones go evenly, hold stays until the next key.
enum class Ease { smooth, linear, hold };

/// A pose at a time.
struct Keyframe {
  double time = 0;  ///< seconds
  Pose pose = {};
  Ease ease = Ease::smooth;
  int turns = 0;  ///< whole turns on the way from the key before, beyond the shortest
  Extra pose_extra = {}, extra = {};
  bool operator==(const Keyframe&) const = default;
};

inline constexpr double kMostPinTurn = 1e5;                    ///< radians
inline constexpr int kMostDepth = 1000;                        ///< of a pin, up or down
inline constexpr double kLongestTime = 3600;                   ///< seconds
inline constexpr double kFewestFrames = 1, kMostFrames = 240;  ///< a second
inline constexpr int kMostTurns = 150;                         ///< on the way to a keyframe
inline constexpr size_t kMostKeyframes = 2000;

/// How a picture is deformed. Rest and pose of the cage have the same number of segments; both are
/// empty until a cage is drawn. Value type.
struct Deformation {
  Cage rest, pose;
  std::vector<Pin> pins = {};
  std::vector<Stroke> strokes = {};
  Points outline = {};  ///< closed; where method `outline` takes the cage's shape
  std::optional<SurfaceReference> surface = {};
  std::vector<Corner> corners = {};      ///< by increasing vertex
  std::vector<BrushDab> stiffness = {};  ///< painted, for methods that use it
  /// By increasing time. Those whose structure differs from the handles' are kept, but do not play.
  std::vector<Keyframe> keyframes = {};
  std::string method = usual_method(MethodUse::cage).id;
  Parameters parameters = {};
  std::map<std::string, Parameters> other_parameters = {};  ///< of methods it had before, by id
  Extra cage_extra = {}, method_extra = {};

  bool has_cage() const { return rest.size() > 0; }
  bool operator==(const Deformation&) const = default;
};

/// Everything that moves, whatever the method uses.
Pose whole_pose_of(const Deformation& deformation);
/// Whether a pose has the deformation's structure.
bool fits(const Deformation& deformation, const Pose& pose);
/// The deformation in a pose that fits.
Deformation posed_as(Deformation deformation, const Pose& pose);

/// What the deformation's method precomputes from, without samples; degrees are high enough for all
/// keyframes.
Rest rest_of(const Deformation& deformation, Precision precision);
/// What moves.
Pose pose_of(const Deformation& deformation);
/// The deformation with everything posed as it rests.
Deformation at_rest(Deformation deformation);
/// The deformation with this cage, everything at rest: pins and strokes keep their rest and
/// return to it.
Deformation with_cage(Deformation deformation, Cage cage);
Deformation with_cage(Deformation deformation, const Points& polygon);

}  // namespace holomorph
