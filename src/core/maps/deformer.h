// The whole public face of the maps: what a method is given (Rest, Pose) and what it answers.
//
// Adding a method is one file in methods/ and one row of the table in methods.cpp; menus, sliders,
// JSON fields, contract tests and benchmarks iterate over the table.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/cauchy/cauchy_array.h"
#include "core/geometry/stiffness.h"
#include "core/mesh/mesh.h"

namespace holomorph {

/// Values of a method's parameters by key; a missing key has the specification's default.
using Parameters = std::map<std::string, double>;

/// One parameter of a method: what a slider, a JSON field and the help need to know. A choice's
/// value is the number of one of its options; files hold the option's id.
struct ParameterSpec {
  struct Option {
    std::string id, label;
  };
  enum class Type { number, toggle, choice };
  std::string key, label, hint;
  Type type = Type::number;
  double fallback = 0, lowest = 0, highest = 1;
  bool logarithmic = false;
  struct Condition {
    std::string key;
    double value = 0;
  };
  std::optional<Condition> used_when = {};  ///< another parameter's value that it takes effect with
  std::vector<Option> options = {};         ///< of a choice
};

enum class Precision {
  single,  ///< operators in float: for the picture (1e-6 of the displacement)
  full     ///< operators in double: for numbers that are written out
};

/// A point handle at rest; `has_frame` says that its pose prescribes an angle and a scale too.
struct RestPin {
  Complex position;
  bool has_frame = false;
  bool operator==(const RestPin&) const = default;
};
inline constexpr double kLeastPinScale = 0.01, kMostPinScale = 100;
struct PosePin {
  Complex position;
  double angle = 0.0;  ///< radians, counter-clockwise; used where the rest pin has a frame
  double scale = 1.0;  ///< kLeastPinScale to kMostPinScale; used where the rest pin has a frame
  bool operator==(const PosePin&) const = default;
};

/// What a corner's boundary angles are besides the posed cage's own: turns in radians, unwrapped.
struct PoseCorner {
  double before = 0.0, after = 0.0;  ///< of the edges that end and start there
  /// Of the edge from here to the next corner, 0 to 1: with 1 its image is as straight as it was,
  /// with 0 it bends so that corners keep their angles.
  double tension = 1.0;
  bool operator==(const PoseCorner&) const = default;
};

/// Everything that forces precomputation. Value type.
struct Rest {
  Cage cage;  ///< straight or curved, each segment of at least its posed counterpart's degree
  std::vector<RestPin> pins;
  std::vector<Points> strokes = {};      ///< open curves, two different points each at least
  Points outline = {};                   ///< closed; where the cage's shape is to go, or none
  std::vector<Index> corners = {};       ///< the cage's vertices with angles, in order; none: all
  std::vector<BrushDab> stiffness = {};  ///< of the picture; none: the same everywhere
  Points samples;                        ///< where the map is wanted, inside or on the cage
  /// Where f_z and f_zbar are wanted, one per sample; empty: at samples. Methods whose derivatives
  /// are finite on the boundary give them at samples.
  Points derivative_samples;
  /// The cage's triangles, for methods that integrate or minimize over them.
  std::shared_ptr<const Mesh> mesh;
  Parameters parameters;
  /// Parameters of other methods by id, for those that follow another one.
  std::map<std::string, Parameters> other_parameters = {};
  Precision precision = Precision::single;
  bool operator==(const Rest&) const = default;
};

/// Everything that moves. Value type; as many segments, control points, pins, strokes and corners
/// as the Rest.
struct Pose {
  Cage cage;
  std::vector<PosePin> pins;
  std::vector<Points> strokes = {};  ///< where those of the rest go, run through the same way
  std::vector<PoseCorner> corners = {};
  bool operator==(const Pose&) const = default;
};

/// A map at the samples of its Rest, with both Wirtinger derivatives
/// f_z = (f_x - i f_y) / 2 and f_zbar = (f_x + i f_y) / 2 when they were asked for (else empty).
struct SampledMap {
  enum class Status { exact, iterating, certified, infeasible };
  VectorXc f, fz, fzbar;
  Status status = Status::exact;
  std::string note;  ///< what the user should know, such as a pin that could not be used
  int iterations = 0;
  /// Of methods whose convergence is worth watching: after each iteration of the whole solve, the
  /// first one before any.
  std::vector<double> energies;
  Points zeros;  ///< where the derivative of a map that was projected vanishes, at rest
  /// The cage's vertices whose angles are held at the least possible one.
  std::vector<Index> limited_corners;
  bool ignores_pins = false;  ///< the method uses pins, but had no use for these
};

/// What is wanted of a map besides its values.
struct EvalOptions {
  bool derivatives = false;
  /// While something is dragged: methods that iterate may go on from their last answer and stop
  /// early. Without it the map depends on rest and pose alone.
  bool draft = false;
  /// The map after so many iterations, of methods that give energies; others take no notice.
  std::optional<int> iteration = {};

  bool operator==(const EvalOptions&) const = default;
};

/// A pose's map at single points; just outside the cage the inner map goes on.
class PointMap {
 public:
  struct Value {
    Complex f, fz, fzbar;
  };
  virtual ~PointMap() = default;
  virtual Value at(Complex z) const = 0;
};

/// What was precomputed from a Rest. Answers poses until the rest changes.
class Deformer {
 public:
  virtual ~Deformer() = default;

  /// The map of a pose. Throws Error when the pose does not fit the rest or is not finite.
  /// Cost for linear methods: one product with an operator of samples x controls.
  virtual SampledMap deform(const Pose& pose, EvalOptions options) = 0;

  /// For methods linear in the pose: f = samples + matrix * controls(pose), so that a vertex shader
  /// can apply the operator itself. Null when the method is not linear or works in full precision.
  virtual const PlanarMatrix<float>* operator_matrix() const { return nullptr; }
  virtual VectorXc controls(const Pose&) const { return {}; }

  /// The posed cage that alone, by method `cage`, gives this pose's map. None where there is no
  /// such cage.
  virtual std::optional<Cage> solved_cage(const Pose&) const { return {}; }

  /// The pose's map at any point, to rounding when the rest is in full precision (methods that
  /// integrate along the mesh: to the error of that). Null when the method knows its map at samples
  /// only.
  virtual std::unique_ptr<PointMap> point_map(const Pose&) const { return nullptr; }
};

/// Parameters under a name, such as "strict"; what is missing has its default.
struct Preset {
  std::string label;
  Parameters parameters;
};

/// A row of the table of methods.
struct Method {
  std::string id, label, hint;
  std::vector<ParameterSpec> parameters;
  bool uses_pins = false;
  bool harmonic = true;  ///< f_z and conj(f_zbar) are holomorphic
  bool similar = true;   ///< a similarity of all handles gives that similarity
  /// What `prepare` calls with a rest that has been checked.
  std::unique_ptr<Deformer> (*make)(const Rest& rest, const Deformer* previous) = nullptr;
  std::vector<Preset> presets = {};
  bool uses_strokes = false, uses_outline = false, uses_corners = false, uses_stiffness = false;
  bool needs_mesh = false;
  bool follows_others = false;  ///< its map is near that of another method, with its parameters

  /// Precomputes. `previous` is this method's last deformer or null; what its rest and the new one
  /// have in common need not be computed again. Throws Error for a rest that cannot be used.
  std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer* previous) const;
};

/// The table of methods, in menu order.
const std::vector<Method>& methods();
/// The row with this id; throws Error naming the ids that exist.
const Method& method_named(const std::string& id);

/// What an edit or a tool needs a method for.
enum class MethodUse { cage, pins, strokes, outline, corners, stiffness, bounds };
/// The method that they choose unless the present one serves.
const Method& usual_method(MethodUse use);
/// The method whose map is meant: the one that a method follows, or itself.
const Method& followed_method(const Method& method, const Parameters& values);

/// Without the handles that the method has no use for.
Rest used_by(const Method& method, Rest rest);
Pose used_by(const Method& method, Pose pose);

/// What a rest holds for a method that its own one follows.
Parameters parameters_of(const Rest& rest, const Method& followed);

/// The parameter's value, its default when missing.
double parameter(const Method& method, const Parameters& values, const std::string& key);
/// Whether a parameter has any effect beside the others' values.
bool is_used(const Method& method, const Parameters& values, const ParameterSpec& spec);
/// The id of the option that a choice has.
std::string choice(const Method& method, const Parameters& values, const std::string& key);

}  // namespace holomorph
