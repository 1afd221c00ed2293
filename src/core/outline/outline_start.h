// Where the points of one outline go on another one under the conformal map of their insides that
// stretches the boundary least: the start of outline matching.
//
// Both are mapped to the disk; what is left is one of the disk's own maps, with three parameters.
#pragma once

#include <memory>

#include "core/geometry/polyline.h"
#include "core/outline/periodic_curve.h"

namespace holomorph {

/// The inner point that is farthest from a closed polyline, to rounding where one is.
Complex deepest_point(const Polyline& outline);

/// A deep point, and of those almost as deep a central one: all of a strip's axis is as deep.
Complex middle_point(const Polyline& outline);

/// An increasing map from arc lengths of one closed curve to those of another one, one turn to one
/// turn.
struct Correspondence {
  PeriodicCurve lengths;  ///< the target's of the source's
  double badness = 0;     ///< root of what was minimized

  double source_length() const { return lengths.x_period; }
  double target_length() const { return lengths.y_period; }
  /// The target's arc length for one of the source's.
  double operator()(double length) const { return lengths(length); }
  /// From the target's arc lengths to the source's.
  Correspondence inverse() const { return {lengths.through_inverse(), badness}; }
};

/// The conformal maps of one outline's inside to another's: both seen from the disk, and which of
/// the disk's own maps is between them.
class ConformalStart {
 public:
  /// Both closed, simple and counter-clockwise, and outliving this; pins inside the source. What is
  /// minimized is the mean square of ln of the relative stretch along both outlines, plus `upright`
  /// times the square of the angle by which the picture is turned (with 0, how the two stand does
  /// not matter), plus 1000 times the squares of the hyperbolic distances of the pins' images from
  /// where they are wanted. Throws Error when an outline touches itself. Cost: about 20 ms.
  ConformalStart(const Polyline& source, const Polyline& target, double upright,
                 const Points& pins = {});
  ~ConformalStart();
  ConformalStart(const ConformalStart&) = delete;
  ConformalStart& operator=(const ConformalStart&) = delete;

  /// Whether places of one of the outlines cannot be told apart on the disk's circle any more, as
  /// those at the ends of strips twelve times as long as wide: no start can be found then.
  bool is_crowded() const;
  /// Whether a hundredth of one of the outlines is seen from its deepest point within 5e-13 of the
  /// whole turn: rounding may spoil the map there.
  bool is_near_crowded() const;
  /// With pins wanted there, or without any. Cost: 3 to 25 ms.
  Correspondence best(const Points& pinned = {});
  /// Makes finer maps to the disk, which see corners that go to long parts of the other outline.
  /// Returns false, and changes nothing, where rounding does not allow it. Cost: about 100 ms.
  bool sharpen();
  /// The last one again, by the maps that there are. Cost: 1 ms.
  Correspondence last(const Points& pinned = {});
  /// Without pins and however the picture is turned: what is stretched least. Cost as above.
  Correspondence least_stretched();
  /// The same, on from the last one, which there must be; about 4 ms.
  Correspondence follow(const Points& pinned);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace holomorph
