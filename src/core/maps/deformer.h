// The public interface of the maps: the input of a method (Rest, Pose) and its output (SampledMap).
//
// To add a method, write a file in methods/ that returns its table row, and add the row to rows.h
// and methods.cpp. Sliders, the palette, JSON fields and the contract tests iterate over the table.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/cauchy/cauchy_array.h"
#include "core/geometry/stiffness.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// Values of a method's parameters by key. A missing key stands for the default in its
/// ParameterSpec.
using Parameters = std::map<std::string, double>;

/// The description of a parameter of a method, for sliders, JSON fields and the help. The value of
/// a choice is the index of the selected option. Files store the option's id.
struct ParameterSpec {
  struct Option {
    std::string id, label;
  };
  enum class Type { number, toggle, choice };
  std::string key, label, hint;
  Type type = Type::number;
  double fallback = 0, lowest = 0, highest = 1;
  bool logarithmic = false;
  bool percent = false;  ///< the interface shows 100 times the value
  struct Condition {
    std::string key;
    double value = 0;
  };
  /// The parameter takes effect only while another parameter has this value.
  std::optional<Condition> used_when = {};
  std::vector<Option> options = {};  ///< for Type::choice
};

enum class Precision {
  single,  ///< operators in float, for display (error 1e-6 of the displacement)
  full     ///< operators in double, for numeric output
};

/// A point handle at rest. With `has_frame`, its pose also prescribes an angle and a scale.
struct RestPin {
  Complex position;
  bool has_frame = false;
  /// The frame acts on a disk of this radius, in methods that hold disks. See held_radius.
  std::optional<double> radius = {};
  bool operator==(const RestPin&) const = default;
};
inline constexpr double kMinPinRadius = 1e-6, kMaxPinRadius = 1e6;
inline constexpr double kMinPinScale = 0.01, kMaxPinScale = 100;
struct PosePin {
  Complex position;
  double angle = 0.0;  ///< radians, counter-clockwise; used if the rest pin has a frame
  double scale = 1.0;  ///< kMinPinScale to kMaxPinScale; used if the rest pin has a frame
  /// The rotation of the picture at the pin in a map that was found before, in radians and
  /// unwrapped. Where a pose has several maps of least energy, the turns decide which one is found.
  std::optional<double> turn = {};
  bool operator==(const PosePin&) const = default;
};

/// Rotations at a corner, in radians and unwrapped. They are added to the boundary angles of the
/// posed cage.
struct PoseCorner {
  double before = 0.0, after = 0.0;  ///< rotations of the edges that end and start here
  /// Tension of the edge from here to the next corner, 0 to 1. At 1 the edge's image is as straight
  /// as the edge at rest; at 0 it bends so that the corners keep their angles.
  double tension = 1.0;
  bool operator==(const PoseCorner&) const = default;
};

/// The inputs that require new precomputation when they change. Value type.
struct Rest {
  Cage cage;  ///< straight or curved; no segment may have a lower degree than the posed segment
  std::vector<RestPin> pins;
  std::vector<Points> strokes = {};  ///< open curves, each with at least two distinct points
  Points outline = {};  ///< closed curve that the cage's shape is mapped onto; empty: none
  std::vector<Index> corners = {};       ///< cage vertices with angles, in order; empty: all
  std::vector<BrushDab> stiffness = {};  ///< stiffness of the picture; empty: uniform
  Points samples;                        ///< where the map is evaluated, inside or on the cage
  /// Where f_z and f_zbar are evaluated, one point per sample. If empty, they are evaluated at
  /// `samples`. Methods whose derivatives are finite on the boundary always evaluate them at
  /// `samples`.
  Points derivative_samples;
  /// The triangulated cage, for methods that integrate or minimize over its triangles.
  std::shared_ptr<const Mesh> mesh;
  Parameters parameters;
  /// Parameters of other methods by id, for methods that follow another method.
  std::map<std::string, Parameters> other_parameters = {};
  Precision precision = Precision::single;
  bool operator==(const Rest&) const = default;
};

/// The inputs that change while handles are moved. Value type. The numbers of segments, pins,
/// strokes and corners are the same as in the Rest.
struct Pose {
  Cage cage;
  std::vector<PosePin> pins;
  std::vector<Points> strokes = {};  ///< targets of the rest's strokes, in the same direction
  std::vector<PoseCorner> corners = {};
  bool operator==(const Pose&) const = default;
};

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
  std::shared_ptr<const Solution> solution;  ///< null if the method does not iterate
};

/// What to compute besides the values of a map, and how.
struct EvalOptions {
  bool derivatives = false;
  /// Set during drags. Iterative methods may then continue from an earlier solution and stop early.
  /// Otherwise, the map depends only on the rest and the pose.
  bool draft = false;
  /// If set, the map is evaluated after this many iterations. Methods that report no energies
  /// ignore this.
  std::optional<int> iteration = {};
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

  /// Motion between final maps of this deformer, with proofs; null if the method proves nothing.
  /// The first call precomputes. Threads: may run at the same time as `deform`.
  virtual std::shared_ptr<const ProvedMotion> motion() const { return nullptr; }
};

/// Named parameter values, such as "strict". Missing parameters have their defaults.
struct Preset {
  std::string label;
  Parameters parameters;
};

/// A row of the table of methods. Rows set fields by name; omitted fields keep their defaults.
struct Method {
  std::string id, label;
  std::string summary;  ///< what it keeps, in one short sentence or two
  std::string hint;
  std::vector<ParameterSpec> parameters = {};
  bool uses_pins = false, uses_strokes = false, uses_outline = false, uses_corners = false,
       uses_stiffness = false;
  bool holds_disks = false;        ///< the frame of a pin acts on a disk, not on its center alone
  bool pins_replace_cage = false;  ///< while there are pins, the posed cage has no effect
  bool iterates = false;           ///< too slow for every frame of a drag: solve it on a worker
  bool harmonic = true;            ///< f_z and conj(f_zbar) are holomorphic
  /// Motions of the plane: if all handles move by one of these, the map is that motion.
  enum class Motions { none, rigid, similar } reproduces = Motions::similar;
  bool needs_mesh = false;   ///< Rest::mesh must be set
  bool allows_holes = true;  ///< the cage may have holes
  bool follows_others =
      false;  ///< approximates the map of another method, which has its own parameters
  /// Called by `prepare` with a checked rest.
  std::unique_ptr<Deformer> (*make)(const Rest& rest, const Deformer* previous) = nullptr;
  std::vector<Preset> presets = {};

  /// Precomputes a deformer. `previous` is this method's last deformer, or null. Work that depends
  /// only on inputs that both rests share need not be repeated. Throws Error for a rest that cannot
  /// be used.
  ///
  /// Threads: this may run on one thread while `previous->deform` runs on another. Therefore `make`
  /// reads only members of `previous` that do not change after construction. It keeps them alive
  /// through shared ownership, because `previous` may be destroyed as soon as this returns.
  std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer* previous) const;
};

/// The table of methods, in menu order.
const std::vector<Method>& methods();
/// The row with this id. Throws Error with a list of the known ids.
const Method& method_named(const std::string& id);

/// The features of a method that an edit or a tool may need.
enum class MethodUse {
  cage,
  puppet,  ///< pins in a cage that is at rest
  pins,    ///< pins and posed cage points
  strokes,
  outline,
  corners,
  stiffness,
  bounds
};
/// The method to switch to when the current one does not support this use.
const Method& usual_method(MethodUse use);
/// The method that this one follows, or the method itself if it follows none.
const Method& followed_method(const Method& method, const Parameters& values);

/// The rest or the pose with only the handles that the method uses.
Rest used_by(const Method& method, Rest rest);
Pose used_by(const Method& method, Pose pose);

/// The parameters that a rest stores for the followed method.
Parameters parameters_of(const Rest& rest, const Method& followed);

/// The parameter's value, or its default when it is missing.
double parameter(const Method& method, const Parameters& values, const std::string& key);
/// Whether a parameter has any effect, given the values of the others.
bool is_used(const Method& method, const Parameters& values, const ParameterSpec& spec);
/// The id of the selected option of a choice.
std::string choice(const Method& method, const Parameters& values, const std::string& key);

}  // namespace holomorph
