// The animation defined by a deformation's keyframes: its map at any time.
#pragma once

#include <map>

#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/mesh/inbetween.h"
#include "scene/prepared_map.h"

namespace holomorph {

/// The displayed time and the kind of blending between keyframes (see AnimationSettings). Without a
/// time, the deformation is displayed in its own pose.
struct Moment {
  std::optional<double> time = {};  ///< seconds
  bool linear_blend = false;
  bool operator==(const Moment&) const = default;
};

/// The piecewise linear map on a mesh with values `f` at the vertices.
SampledMap blended_map(const Mesh& mesh, VectorXc f, bool derivatives);

/// The maps at keyframes and between them. The maps at keyframes are cached until their inputs
/// change.
class Motion {
 public:
  /// Updates the maps at a deformation's keyframes. Only maps of changed poses are recomputed.
  /// `prepared` must be the prepared map of the deformation. Keyframes without a valid map are left
  /// out, and error() returns the first reason. Cost: one final pose for each changed keyframe.
  /// Throws Error{bad_input} if the maps would need more memory than the budget allows, and Stopped
  /// on request. The maps found until then are kept for the next call; nothing plays before it.
  void follow(const Deformation& deformation, bool linear_blend,
              std::shared_ptr<PreparedMap> prepared, const std::stop_token& stop = {});
  /// The same, but computes only the maps on which the one at a time depends: those at the keys
  /// around it, and at their neighbors where the motion is smooth. Throws Error if one of these
  /// keys has no map. Maps at other times must not be requested. Cost: at most four final poses.
  void follow_at(double time, const Deformation& deformation, bool linear_blend,
                 std::shared_ptr<PreparedMap> prepared);
  void clear() { *this = Motion(); }

  /// The number of final poses that follow() would compute.
  size_t unknown(const Deformation& deformation,
                 const std::shared_ptr<PreparedMap>& prepared) const;

  /// Whether any key has a map. If so, there is a map at any time.
  bool plays() const { return !keys_.empty() && !stopped_; }
  const std::optional<Error>& error() const { return error_; }

  /// The map at the last key before a time, or at the first key after it if `later` is true. Null
  /// if there is no such key.
  const VectorXc* neighboring_key(double time, bool later) const;
  /// The key pose that is displayed at a time: at a key, while a key is held, between two keys if
  /// nothing moves, before the first key and after the last key. Null at all other times.
  const Pose* pose_at(double time);
  /// How far the picture rotates on average from one time to another, in radians, including whole
  /// turns.
  double rotation_between(double from, double to);
  /// By how much the picture rotates more than expected, where the expected rotation is known.
  double rotation_beyond(double from, double to, const ExpectedTurn& expected);
  /// Whether a time lies between the first key and the last key, inclusive.
  bool covers(double time) const {
    return plays() && keys_.front().time <= time && time <= keys_.back().time;
  }

  /// The interval between two successive keys that play.
  struct KeyInterval {
    double from = 0, to = 0;
    bool held = false;  ///< the first key's pose is displayed until the interval ends
  };
  std::vector<KeyInterval> key_intervals() const;

  /// f at the mesh's vertices at a time. Constant before the first key and after the last key.
  VectorXc map_at(double time);
  /// The map at a time, with derivatives if requested. Between keys, it is certified if the method
  /// proves its maps and both keys are certified, and otherwise blended triangle by triangle. At a
  /// key, it has the key's certificate, if there is one. `measures`: sets SampledMap::extremes,
  /// too.
  SampledMap sampled_at(double time, bool derivatives, bool measures = false);
  /// A result of sampled_at() at single points.
  std::unique_ptr<PointMap> point_map(const SampledMap& map) const;
  /// The deformation with its handles in their positions at a time. `map` must be map_at(time).
  /// Between two keyframes, the handles follow the picture around them.
  Deformation deformation_at(const Deformation& deformation, double time, const VectorXc& map);

 private:
  struct Key {
    double time = 0;
    Ease ease = Ease::smooth;
    int turns = 0;
    Pose pose;
    /// At the mesh's vertices. Empty if it is not known yet.
    VectorXc f = {};
    std::shared_ptr<const Solution> solution = {};  ///< only if the method proves its maps
    std::optional<Extremes> extremes = {};
    std::string note = {};          ///< of the certified map
    bool has_turns = false;         ///< SampledMap::turns are known: the map depends on them
    ExpectedTurn turn_before = {};  ///< since the key before it
  };
  /// The shapes at both ends of an interval without proof, and their rates of change if the motion
  /// is smooth.
  struct Blend {
    size_t from = 0;
    Inbetween::Shape at_from, at_to;
    std::optional<VectorXc> slope_from, slope_to;
    Location still;  ///< the least_moving_point
  };
  /// A time relative to the keys. If u = 0, the pose of key `from` is displayed. If u > 0, the time
  /// is at the fraction u of the interval from that key to the next.
  struct TimePosition {
    size_t from = 0;
    double u = 0;
  };
  /// The first-order behavior of a map near a rest position z: w -> f + fz (w - z).
  struct LocalMap {
    Complex f, fz;
  };
  void list_keys(const Deformation& deformation, bool linear_blend,
                 std::shared_ptr<PreparedMap> prepared);
  void find_map(Key& key, const Deformation& deformation, const std::stop_token& stop) const;
  void count_turns(const Deformation& deformation);
  TimePosition position_of(double time) const;
  LocalMap local_map_at(Complex rest, const VectorXc& map);
  void add_turns(const Deformation& deformation, const VectorXc& map, Pose& pose) const;
  const Inbetween::Shape& shape_at(size_t key);
  Inbetween::Shape shape_after(const Inbetween::Shape& before, size_t key);
  Inbetween::Shape shape_before(const Inbetween::Shape& after, size_t key);
  double rotation_after(size_t key);
  const Blend& blend_from(size_t key);
  bool passes(size_t key) const;
  const MotionInterval* interval_from(size_t key);

  std::vector<Key> keys_;
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Inbetween> between_;
  bool linear_blend_ = false;
  bool stopped_ = false;  ///< whether the last call of follow() was stopped
  std::optional<Error> error_;
  std::vector<std::pair<Pose, Error>> invalid_;  ///< poses without a map, and why
  std::map<std::pair<double, double>, Location> locations_;
  // A shape needs eight times as much memory as its map. Therefore only the shapes near the
  // requested time are cached.
  std::map<size_t, Inbetween::Shape> shapes_;  ///< by key, without whole turns
  std::optional<Blend> blend_;
  std::shared_ptr<const ProvedMotion> proved_;  ///< null if the method proves nothing
  struct KnownInterval {
    size_t from = 0;
    std::shared_ptr<const MotionInterval> interval;  ///< null if the keys are not certified
  };
  std::optional<KnownInterval> interval_;
};

/// Preserves the rotation of the picture after keys were added to `before`. Sets the number of
/// whole turns of each new key and of the key after it. `motion` must be the motion of `before`.
void preserve_turns(Deformation& deformation, const Deformation& before, Motion& motion);

}  // namespace holomorph
