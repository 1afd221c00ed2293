// The map of a deformation's keyframes at any time.
#pragma once

#include <map>

#include "core/error.h"
#include "core/mesh/inbetween.h"
#include "scene/prepared_map.h"

namespace holomorph {

/// The time at which a deformation is displayed (none: in its own pose), and how
/// poses are blended between keyframes, as in AnimationSettings.
struct Moment {
  std::optional<double> time = {};  ///< seconds
  bool linear_blend = false;
  bool operator==(const Moment&) const = default;
};

/// The map that is linear in each triangle of a mesh, from its values at the vertices.
SampledMap blended_map(const Mesh& mesh, VectorXc f, bool derivatives);

/// The maps at keyframes, kept until their inputs change, and the maps in between.
class Motion {
 public:
  /// Updates the maps at a deformation's keyframes; the deformer recomputes those whose pose has
  /// changed. `prepared` must be prepared for the deformation. Keyframes that cannot be mapped are
  /// left out; error() gives the reason for the first one. Cost: a final pose for each changed
  /// keyframe. Throws Error{bad_input} if the maps would need more memory than the budget allows.
  void follow(const Deformation& deformation, bool linear_blend,
              std::shared_ptr<PreparedMap> prepared);
  void clear() { *this = Motion(); }

  /// The number of final poses that follow() would compute.
  size_t unknown(const Deformation& deformation,
                 const std::shared_ptr<PreparedMap>& prepared) const;

  /// Whether there are maps at keys. If so, there is a map at any time.
  bool plays() const { return !keys_.empty(); }
  const std::optional<Error>& error() const { return error_; }

  /// The map at the last key before a time or, if `later`, at the first key after it. Null if there
  /// is no such key.
  const VectorXc* neighboring_key(double time, bool later) const;
  /// The key pose that is displayed at a time: at a key, while a key is held, before the first key
  /// and after the last one. Null while the pose changes between two keys.
  const Pose* pose_at(double time);
  /// The average rotation of the picture at a time, in radians, including whole turns.
  double rotation_at(double time) const;
  /// Whether a time is between the first key and the last.
  bool covers(double time) const {
    return plays() && keys_.front().time <= time && time <= keys_.back().time;
  }

  /// The interval from one key that plays to the next.
  struct KeyInterval {
    double from = 0, to = 0;
    bool held = false;  ///< nothing moves until its end
  };
  std::vector<KeyInterval> key_intervals() const;

  /// f at the mesh's vertices. It is constant before the first key and after the last one.
  VectorXc map_at(double time);
  /// The deformation with its handles as they are in `map`, which must be map_at(time). Between two
  /// keyframes the handles follow the picture around them.
  Deformation deformation_at(const Deformation& deformation, double time, const VectorXc& map);

 private:
  struct Key {
    double time = 0;
    Ease ease = Ease::smooth;
    int turns = 0;
    Pose pose;
    VectorXc f;           ///< at the mesh's vertices
    int whole_turns = 0;  ///< whole turns of its shape
    double turned = 0;    ///< average rotation in radians
  };
  /// The rates of change of all quantities at the two keys of an interval.
  struct Slopes {
    size_t from = 0;
    VectorXc at_from, at_to;
  };
  /// The position of a time: at key `from` or, for u > 0, at the fraction u of the way to the next
  /// key.
  struct TimePosition {
    size_t from = 0;
    double u = 0;
  };
  /// The first-order behavior of a map near a rest position z: w -> f + fz (w - z).
  struct LocalMap {
    Complex f, fz;
  };
  TimePosition position_of(double time) const;
  LocalMap local_map_at(Complex rest, const VectorXc& map);
  void align(const Deformation& deformation);
  const Inbetween::Shape& shape_at(size_t key);
  VectorXc slopes_at(size_t key);
  const Slopes& slopes_from(size_t key);

  std::vector<Key> keys_;
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Inbetween> between_;
  bool linear_blend_ = false;
  std::optional<Error> error_;
  std::map<std::pair<double, double>, Location> locations_;
  // A shape takes eight times the memory of its map, so only those near the requested time are
  // kept.
  std::map<size_t, Inbetween::Shape> shapes_;  ///< by key
  std::optional<Slopes> slopes_;
};

/// Sets the whole turns of the keys that `before` does not have, and of the keys after them, so
/// that the picture rotates as it did in `motion`, the motion of `before`.
void preserve_turns(Deformation& deformation, const Deformation& before, Motion& motion);

}  // namespace holomorph
