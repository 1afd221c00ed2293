// The output of a method: maps of poses (SampledMap), and the Deformer that computes them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/cauchy/cauchy_array.h"
#include "core/maps/rest.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// What an iterating method has found, as a value from which a draft can continue. Each method has
/// its own type.
struct Solution {
  virtual ~Solution() = default;
};

/// The strongest distortions anywhere in the picture, not only at samples.
struct Extremes {
  double shear = 0;                  ///< the largest |f_zbar / f_z|
  double smallest = 1, largest = 1;  ///< |f_z| - |f_zbar| and |f_z| + |f_zbar|
};

/// A map at the samples of its Rest, with both Wirtinger derivatives f_z = (f_x - i f_y) / 2 and
/// f_zbar = (f_x + i f_y) / 2 if they were requested (else empty).
struct SampledMap {
  enum class Status { exact, iterating, certified, infeasible };
  VectorXc f, fz, fzbar;
  Status status = Status::exact;
  std::string note;  ///< what the user should know, for example that a pin could not be used
  int iterations = 0;
  /// The energy before the first iteration of the whole solve and after each iteration, for methods
  /// that report it.
  std::vector<double> energies;
  Points zeros;  ///< zeros of f_z in the map that was projected, at rest
  /// Cage vertices whose angles are clamped to the smallest possible angle.
  std::vector<Index> limited_corners;
  /// For final maps that are certified: proved limits, within 1 % of values that are attained.
  std::optional<Extremes> extremes;
  bool ignores_pins = false;  ///< the method supports pins but ignored these
  /// The rotation of the picture at each pin, for methods whose maps depend on it; none for pins
  /// that were ignored. Otherwise empty.
  std::vector<std::optional<double>> turns;
  /// After a release: the turns of the pins with which the pose has this map. Empty if these are
  /// the pose's own.
  std::vector<std::optional<double>> better_turns;
  /// Inverted triangles of a mesh that is too coarse for this map, which does not fold.
  int coarse_triangles = 0;
  std::shared_ptr<const Solution> solution;  ///< null if the method does not iterate
};

/// What to compute besides the values of a map, and how.
struct EvalOptions {
  bool derivatives = false;
  /// Set during drags. Iterative methods may then continue from an earlier solution and stop early.
  /// Otherwise, the map depends only on the rest and the pose, with better turns if there are any.
  bool draft = false;
  /// If set, the map is evaluated after this many iterations. Methods that report no energies
  /// ignore this.
  std::optional<int> iteration = {};
  /// Set for the final map that follows the last draft of a drag. If the turns of the pins lead to
  /// another map than the draft, better ones are looked for, and the map is theirs.
  bool released = false;
  /// Lets another thread end a slow final answer: `deform` then throws Stopped. Methods that are
  /// fast enough may finish instead.
  std::stop_token stop = {};

  bool operator==(const EvalOptions&) const = default;
};

/// The map of a pose at single points. Just outside the cage, the map is continued from inside.
/// Threads: const functions may run at the same time.
class PointMap {
 public:
  struct Value {
    Complex f, fz, fzbar;
  };
  virtual ~PointMap() = default;
  virtual Value at(Complex z) const = 0;
  /// The same for many points, in less time for methods that share work between points.
  virtual std::vector<Value> values_at(std::span<const Complex> points) const;
  /// Whether the map is linear in each triangle of the rest's mesh.
  virtual bool is_linear_in_triangles() const { return false; }
  /// Whether f_z is known to have no zeros inside. Its values may be too small to show this.
  virtual bool has_no_zeros() const { return false; }
  /// Whether the map is put together from pieces, so that its second derivatives may jump.
  virtual bool is_piecewise() const { return false; }
};

/// The values and derivatives of a map at many points.
using PointValues = std::function<std::vector<PointMap::Value>(std::span<const Complex>)>;
/// PointMap::values_at() on all cores. Calls `keep_going` on this thread from time to time; an
/// exception from it ends the work and is rethrown.
std::vector<PointMap::Value> values_on_all_cores(
    const PointMap& map, std::span<const Complex> points,
    const std::function<void()>& keep_going = [] {});

/// The final map of a pose, as a key of a motion.
struct MotionKey {
  std::shared_ptr<const Solution> solution;
  std::optional<Extremes> extremes;  ///< SampledMap::extremes
  const Pose* pose;
  const VectorXc* f;    ///< at the mesh's vertices
  double rotation = 0;  ///< the average rotation of the picture in radians, with whole turns
  double time = 0;
  double asked = 0;  ///< the rotation in radians since the key before it that pins or turns ask for
};

/// The motion from one key to the next.
class MotionInterval {
 public:
  virtual ~MotionInterval() = default;
  /// The map at the mesh's vertices, with derivatives, at the fraction u of the time, 0 < u < 1.
  /// It has the status certified if the proof succeeds. `measures`: sets `extremes`, too.
  virtual SampledMap at(double u, bool measures) const = 0;
};

/// Motion of a method whose maps are proved not to fold, which is proved, too. Threads: const
/// functions may run at the same time as all functions of the deformer.
class ProvedMotion {
 public:
  virtual ~ProvedMotion() = default;
  /// The motion between two keys, linear in time, or smooth: with the velocities that the keys on
  /// both sides suggest, or from rest and to rest without them. Null if a key is not certified. The
  /// result does not refer to its arguments.
  virtual std::unique_ptr<MotionInterval> interval(const MotionKey* before, const MotionKey& from,
                                                   const MotionKey& to, const MotionKey* after,
                                                   bool smooth) const = 0;
  /// A map that an interval has given, at single points. Null if it is linear in each triangle.
  virtual std::unique_ptr<PointMap> point_map(const SampledMap& /*between*/) const {
    return nullptr;
  }
};

/// The precomputed data of a Rest. Computes the map of any pose until the rest changes.
class Deformer {
 public:
  virtual ~Deformer() = default;

  /// The map of a pose. A draft may continue from `from`, the solution of an earlier map of this
  /// deformer; solutions of other deformers are ignored. Nothing else that was computed before
  /// changes the map. Throws Error when the pose does not match the rest or is not finite. Cost for
  /// linear methods: one product with an operator of samples x controls.
  virtual SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) = 0;
  SampledMap deform(const Pose& pose, EvalOptions options) {
    return deform(pose, options, nullptr);
  }

  /// The matrix in f = samples + matrix * controls(pose), for methods that are linear in the pose.
  /// A vertex shader can apply it. Null when the method is not linear or works in full precision.
  virtual const PlanarMatrix<float>* operator_matrix() const { return nullptr; }
  virtual VectorXc controls(const Pose&) const { return {}; }

  /// The posed cage for which the `cage` method yields the same map as this pose. Empty when no
  /// such cage exists.
  virtual std::optional<Cage> solved_cage(const Pose&) const { return {}; }

  /// The map of a pose at any point. If the rest is in full precision, the map is accurate to
  /// rounding error, or to the integration error for methods that integrate along the mesh. Null
  /// when the method knows its map only at the samples.
  virtual std::unique_ptr<PointMap> point_map(const Pose&) const { return nullptr; }

  /// The radius of the disk that a pin with a frame holds, if the pin has none of its own and the
  /// method chooses one. None: held_radius(cage, pin).
  virtual std::optional<double> usual_radius(size_t /*pin*/) const { return {}; }

  /// Motion between final maps of this deformer, with proofs; null if the method proves nothing.
  /// The first call precomputes. Threads: may run at the same time as `deform`.
  virtual std::shared_ptr<const ProvedMotion> motion() const { return nullptr; }
};

}  // namespace holomorph
