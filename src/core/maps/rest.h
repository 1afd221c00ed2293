// The input of a method: what requires precomputation when it changes (Rest), and what moves
// (Pose).
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/geometry/cage.h"
#include "core/geometry/stiffness.h"

namespace holomorph {

struct Mesh;

/// Values of a method's parameters by key. A missing key stands for the default in its
/// ParameterSpec.
using Parameters = std::map<std::string, double>;

enum class Precision {
  single,  ///< operators in float, for display (error 1e-6 of the displacement)
  full     ///< operators in double, for numeric output
};

/// What the outline of the picture may do: follow the handles; slide along itself, so that a
/// rectangle remains one; or nothing. Only what lies on horizontal and vertical sides can slide.
enum class Frame { free, slide, fixed };

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

/// A turn of a pin as it is stored. It only has to be near.
inline double stored_turn(double radians) {
  constexpr double kSteps = 1000;  // per radian
  return std::round(kSteps * radians) / kSteps;
}

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
  Frame frame = Frame::free;
  /// In methods with frames: what is farther than this from all pins stays; none: nothing does.
  std::optional<double> held_beyond = {};
  Points samples;  ///< where the map is evaluated, inside or on the cage
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
  /// A finer mesh whose vertices are the samples, for methods that solve on a coarser one: the
  /// triangles that are drawn. Null if there is none.
  std::shared_ptr<const Mesh> drawn = {};
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

}  // namespace holomorph
