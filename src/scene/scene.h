// What the user made and what a file holds: a plain value.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "core/maps/deformer.h"
#include "core/mesh/flatten.h"
#include "core/mesh/surface.h"

namespace holomorph {

/// JSON object text of keys that this version does not know; they are kept and written back.
using Extra = std::string;

/// The picture that a scene bends, and what its file was. In a file the path is relative to the
/// scene's folder, in a loaded scene absolute.
struct ImageReference {
  std::string file;
  std::string entry = {};  ///< which layer of an OpenRaster file: its file in there
  int width = 0, height = 0;
  std::string sha256;
  Extra extra;
  bool operator==(const ImageReference&) const = default;
};

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

/// What is set for all keyframes together.
struct AnimationSettings {
  double frames_per_second = 24;
  bool straight = false;  ///< in-betweens blend places instead of shapes, to compare
  bool operator==(const AnimationSettings&) const = default;
};
inline constexpr double kMostPinTurn = 1e5;                    ///< radians
inline constexpr int kMostDepth = 1000;                        ///< of a pin, up or down
inline constexpr double kLongestTime = 3600;                   ///< seconds
inline constexpr double kFewestFrames = 1, kMostFrames = 240;  ///< a second
inline constexpr int kMostTurns = 150;                         ///< on the way to a keyframe
inline constexpr size_t kMostKeyframes = 2000;

/// How a layer stands among the others.
struct LayerState {
  int id = 1;  ///< tells layers of a session apart; not saved
  std::string name = {};
  bool visible = true;
  bool locked = false;  ///< edits are refused
  Extra extra = {};
  /// Whatever their ids.
  bool operator==(const LayerState& other) const {
    return name == other.name && visible == other.visible && locked == other.locked &&
           extra == other.extra;
  }
};

struct Scene;
/// A layer that is not being edited. Shared, because every drag copies scenes.
class OtherLayer {
 public:
  explicit OtherLayer(Scene layer);
  const Scene& operator*() const { return *layer_; }
  const Scene* operator->() const { return layer_.get(); }
  bool operator==(const OtherLayer& other) const;

 private:
  std::shared_ptr<const Scene> layer_;
};

/// What is seen where no layer is: nothing, a colour, or the pictures as they were.
struct Background {
  enum class Kind { transparent, color, original };
  Kind kind = Kind::transparent;
  std::array<std::uint8_t, 3> color{255, 255, 255};  ///< red, green, blue
  bool operator==(const Background&) const = default;
};

/// All that is saved: the layer that is being edited, the others, and what all of them share. A
/// layer's rest and pose of the cage have the same number of segments; both are empty
/// until a cage is drawn. See layers.h for what is done with them.
struct Scene {
  std::optional<ImageReference> image;
  Cage rest, pose;
  std::vector<Pin> pins;
  std::vector<Stroke> strokes;
  Points outline;  ///< closed; where method `outline` takes the cage's shape
  std::optional<SurfaceReference> surface = {};
  std::vector<Corner> corners = {};  ///< by increasing vertex
  std::vector<Dab> stiffness = {};   ///< painted, where the method knows it
  /// By increasing time. Those that have another structure than the scene by now are kept, but do
  /// not play.
  std::vector<Keyframe> keyframes = {};
  AnimationSettings animation;  ///< the same for all layers
  std::string method = "cage";
  Parameters parameters;
  std::map<std::string, Parameters> other_parameters = {};  ///< of methods it had before, by id
  Extra cage_extra, method_extra;

  LayerState layer = {};
  std::vector<OtherLayer> below = {}, above = {};  ///< from the bottom to the top

  Background background = {};  ///< like the rest the edited layer's, for all
  Extra animation_extra, extra;

  bool has_cage() const { return rest.size() > 0; }
  bool operator==(const Scene&) const = default;
};

/// Everything that moves, whatever the method uses.
Pose whole_pose_of(const Scene& scene);
/// Whether a pose has the scene's structure.
bool fits(const Scene& scene, const Pose& pose);
/// The scene in a pose that fits.
Scene posed_as(Scene scene, const Pose& pose);

/// What the scene's method precomputes from, without samples; degrees are high enough for all
/// keyframes.
Rest rest_of(const Scene& scene, Precision precision);
/// What moves.
Pose pose_of(const Scene& scene);
/// The scene with everything posed as it rests.
Scene at_rest(Scene scene);
/// The scene with this cage, everything at rest: pins and strokes keep their rest and
/// return to it.
Scene with_cage(Scene scene, Cage cage);
Scene with_cage(Scene scene, const Points& polygon);

}  // namespace holomorph
