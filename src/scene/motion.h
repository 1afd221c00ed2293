// A deformation's keyframes as one map at any time.
#pragma once

#include <map>

#include "core/error.h"
#include "core/mesh/inbetween.h"
#include "scene/prepared_map.h"

namespace holomorph {

/// Which time of its keyframes a deformation is shown at: none, its own pose; and how poses between
/// them are blended, as AnimationSettings has it.
struct Moment {
  std::optional<double> time = {};  ///< seconds
  bool linear_blend = false;
  bool operator==(const Moment&) const = default;
};

/// The map that is linear in a mesh's triangles, from its values at the vertices.
SampledMap blended_map(const Mesh& mesh, VectorXc f, bool derivatives);

/// The maps at keyframes, kept until what they depend on changes; and what is between them.
class Motion {
 public:
  /// Brings the maps at a deformation's keyframes up to date: those whose pose has changed are
  /// asked of the deformer. The prepared map must be the deformation's. Keyframes that cannot be
  /// mapped are left out; the first one's reason is error(). Cost: a final pose for each changed
  /// keyframe. Throws Error{bad_input} when the maps would need more memory than the budget has.
  void follow(const Deformation& deformation, bool linear_blend,
              std::shared_ptr<PreparedMap> prepared);
  void clear() { *this = Motion(); }

  /// How many final poses follow() would cost now.
  size_t unknown(const Deformation& deformation,
                 const std::shared_ptr<PreparedMap>& prepared) const;

  /// Whether there is a map at any time.
  bool plays() const { return !keys_.empty(); }
  const std::optional<Error>& error() const { return error_; }

  /// The map at the last key before a time, or the first one behind it; null without one.
  const VectorXc* key_beside(double time, bool later) const;
  /// The pose that is shown at a time: a key's, where one is or is held, and before the first and
  /// after the last; null on the way between two.
  const Pose* pose_at(double time) const;
  /// By how much the picture has turned at a time, on average; whole turns count.
  double turned_at(double time) const;
  /// Between the first key and the last.
  bool covers(double time) const {
    return plays() && keys_.front().time <= time && time <= keys_.back().time;
  }

  /// From one key that plays to the next.
  struct Stretch {
    double from = 0, to = 0;
    bool held = false;  ///< nothing moves until the end
  };
  std::vector<Stretch> stretches() const;

  /// f at the mesh's vertices; before the first key and behind the last one as there.
  VectorXc map_at(double time) const;
  /// The deformation with its handles as they are in that map, which is map_at: on the way from one
  /// keyframe to the next one they go with the picture around them.
  Deformation deformation_at(const Deformation& deformation, double time,
                             const VectorXc& map) const;

 private:
  struct Key {
    double time = 0;
    Ease ease = Ease::smooth;
    int turns = 0;
    Pose pose;
    VectorXc f;           ///< at the mesh's vertices
    int whole_turns = 0;  ///< of its shape
    double turned = 0;    ///< radians, on average
  };
  /// How fast each quantity passes the keys of one interval.
  struct Slopes {
    size_t from = 0;
    VectorXc at_from, at_to;
  };
  /// Where a time lies: at key `from`, or on the way to the next one.
  struct Place {
    size_t from = 0;
    double u = 0;
  };
  /// What a map does near a place at rest: w -> f + fz (w - z).
  struct Frame {
    Complex f, fz;
  };
  Place place_of(double time) const;
  Frame frame_at(Complex rest, const VectorXc& map) const;
  void align(const Deformation& deformation);
  const Inbetween::Shape& shape_at(size_t key) const;
  VectorXc slopes_at(size_t key) const;
  const Slopes& slopes_from(size_t key) const;

  std::vector<Key> keys_;
  std::shared_ptr<PreparedMap> prepared_;
  std::shared_ptr<const Inbetween> between_;
  bool linear_blend_ = false;
  std::optional<Error> error_;
  mutable std::map<std::pair<double, double>, Location> locations_;
  // A shape takes eight times the memory of its map: those around the time that is asked for are
  // kept.
  mutable std::map<size_t, Inbetween::Shape> shapes_;  ///< by key
  mutable std::optional<Slopes> slopes_;
};

/// Sets the whole turns of keys that `before` has not, and of those behind them, so that the
/// picture turns as it did in the motion of `before`.
void keep_turns(Deformation& deformation, const Deformation& before, const Motion& motion);

}  // namespace holomorph
