// Where the points of one outline go on another one under the conformal map of their insides that
// stretches the boundary least: the start of outline matching.
//
// Both are mapped to the disk; what is left is one of the disk's own maps, with three parameters.
#pragma once

#include <memory>

#include "core/polyline.h"

namespace holomorph {

/// The inner point that is farthest from a closed polyline, to rounding where one is.
Complex deepest_point(const Polyline& outline);

/// An increasing map from arc lengths of one closed curve to those of another one, one turn to one
/// turn.
struct Correspondence {
  std::vector<double> source, target;  ///< both increasing, the same number
  double source_length = 0, target_length = 0;
  double badness = 0;  ///< root of what was minimised

  /// The target's arc length for one of the source's.
  double operator()(double length) const;
  /// From the target's arc lengths to the source's.
  Correspondence inverse() const;
};

/// The conformal maps of one outline's inside to another's: both seen from the disk, and which of
/// the disk's own maps is between them.
class ConformalStart {
 public:
  /// Both closed, simple and counter-clockwise, and outliving this; pins inside the source. What is
  /// minimised is the mean square of ln of the relative stretch along the boundary, plus `upright`
  /// times the square of the angle by which the picture is turned (with 0, how the two stand does
  /// not matter), plus 10 times the squares of the hyperbolic distances of the pins' images from
  /// where they are wanted. Throws Error when an outline touches itself. Cost: about 20 ms.
  ConformalStart(const Polyline& source, const Polyline& target, double upright,
                 const Points& pins = {});
  ~ConformalStart();
  ConformalStart(const ConformalStart&) = delete;
  ConformalStart& operator=(const ConformalStart&) = delete;

  /// Whether places of one of the outlines cannot be told apart on the disk's circle any more, as
  /// those at the ends of strips twelve times as long as wide: no start can be found then.
  bool is_crowded() const;
  /// With pins wanted there, or without any. Cost: 3 to 25 ms.
  Correspondence best(const Points& pinned = {});
  /// The same, on from the last one, which there must be; about 4 ms.
  Correspondence follow(const Points& pinned);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace holomorph
