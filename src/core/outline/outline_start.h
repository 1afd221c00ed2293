// The start of outline matching: the correspondence between two outlines under the conformal map of
// their interiors that stretches the boundary least.
//
// Both interiors are mapped to the unit disk. The remaining unknown is an automorphism of the disk,
// which has three parameters.
#pragma once

#include <memory>

#include "core/geometry/polyline.h"
#include "core/outline/periodic_curve.h"

namespace holomorph {

/// The interior point farthest from a closed polyline, accurate to rounding where it is unique.
Complex deepest_point(const Polyline& outline);

/// A central point among those that are almost as deep as the deepest point. (All points on the
/// axis of a strip are equally deep.)
Complex middle_point(const Polyline& outline);

/// An increasing map from the arc lengths of one closed curve to those of another. One turn of the
/// source goes to one turn of the target.
struct Correspondence {
  PeriodicCurve lengths;  ///< the target's arc lengths as a function of the source's
  double residual = 0;    ///< square root of the minimized cost

  double source_length() const { return lengths.x_period; }
  double target_length() const { return lengths.y_period; }
  /// The target's arc length for one of the source's.
  double operator()(double length) const { return lengths(length); }
  /// From the target's arc lengths to the source's.
  Correspondence inverse() const { return {lengths.through_inverse(), residual}; }
};

/// A conformal map from the interior of one outline to that of another: the Riemann maps of both,
/// and the automorphism of the disk between them.
class ConformalStart {
 public:
  /// Both outlines must be closed, simple and counter-clockwise, and must outlive this. The pins
  /// are inside the source. The cost to be minimized is the mean square of ln of the relative
  /// stretch along both outlines, plus `upright` times the squared angle by which the picture is
  /// rotated (with 0, the orientation of the drawings does not matter), plus 1000 times the squared
  /// hyperbolic distances of the pins' images from their targets. Throws Error when an outline
  /// touches itself. Cost: about 20 ms.
  ConformalStart(const Polyline& source, const Polyline& target, double upright,
                 const Points& pins = {});
  ~ConformalStart();
  ConformalStart(const ConformalStart&) = delete;
  ConformalStart& operator=(const ConformalStart&) = delete;

  /// Whether many points of one of the outlines coincide on the disk's boundary to within rounding,
  /// such as those at the ends of strips twelve times as long as wide. No start can be found then.
  bool is_crowded() const;
  /// Whether some hundredth of one of the outlines covers less than 5e-13 of the disk's boundary.
  /// Rounding may spoil the map there.
  bool is_near_crowded() const;
  /// The best correspondence for these targets of the pins, or without pins. Cost: 3 to 25 ms.
  Correspondence best(const Points& pinned = {});
  /// Computes finer maps to the disk, which resolve corners that go to long parts of the other
  /// outline. Returns false and changes nothing where rounding does not allow this. Cost: about 100
  /// ms.
  bool sharpen();
  /// The last correspondence, recomputed with the present maps to the disk. Cost: 1 ms.
  Correspondence last(const Points& pinned = {});
  /// The correspondence with the least stretch, without pins and for any rotation of the picture.
  /// Cost: that of `best`.
  Correspondence least_stretched();
  /// Like `best`, but continues from the last correspondence, which must exist. Cost: about 4 ms.
  Correspondence follow(const Points& pinned);

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

}  // namespace holomorph
