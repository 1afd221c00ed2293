// The start of outline matching: the correspondence between two outlines under the conformal map of
// their interiors that stretches the boundary least.
//
// Both interiors are mapped to the unit disk. The remaining unknown is an automorphism of the disk,
// which has three parameters.
#pragma once

#include <array>
#include <memory>

#include "core/geometry/polyline.h"
#include "core/outline/periodic_curve.h"

namespace holomorph {

/// An increasing map from the arc lengths of one closed curve to those of another. One turn around
/// the source corresponds to one turn around the target.
struct Correspondence {
  PeriodicCurve lengths;  ///< the target's arc lengths as a function of the source's
  double residual = 0;    ///< square root of the minimized cost

  double source_length() const { return lengths.x_period; }
  double target_length() const { return lengths.y_period; }
  /// The target's arc length that corresponds to an arc length of the source.
  double operator()(double length) const { return lengths(length); }
  /// The correspondence from the target to the source.
  Correspondence inverse() const { return {lengths.through_inverse(), residual}; }
};

/// A conformal map from the interior of one outline to the interior of another. It consists of the
/// Riemann maps of both interiors and an automorphism of the disk between them.
class ConformalStart {
 public:
  /// Both outlines must be closed, simple and counter-clockwise, and must outlive this object. The
  /// pins are inside the source. The cost to be minimized has three terms: the mean square of ln of
  /// the relative stretch along both outlines, `upright` times the squared angle by which the
  /// picture is rotated, and 1000 times the squared hyperbolic distances of the pins' images from
  /// their targets. With the stretch along the source alone, a disk would be mapped onto a bar with
  /// its center at one end. If the pins were not part of the cost, they would pull on a map that
  /// does not suit them and fold it. If `upright` is 0, the orientation of the drawings does not
  /// matter. Throws Error when an outline touches itself. Cost: about 20 ms, and up to 2 s for thin
  /// outlines.
  ConformalStart(const Polyline& source, const Polyline& target, double upright,
                 const Points& pins = {});
  ~ConformalStart();
  ConformalStart(const ConformalStart&) = delete;
  ConformalStart& operator=(const ConformalStart&) = delete;

  /// Whether many points of either outline coincide on the disk's boundary to within rounding, as
  /// at the ends of a strip twelve times as long as it is wide, or either outline is so thin that
  /// its Riemann map would take seconds. In that case, no other function may be called.
  bool is_crowded() const;
  /// Whether a hundredth of either outline covers less than 5e-13 of the disk's boundary. Rounding
  /// may spoil the map there.
  bool is_near_crowded() const;
  /// The best correspondence for these pin targets. Without targets, pins are ignored. Cost: 3 to
  /// 25 ms.
  Correspondence best(const Points& pinned = {});
  /// Sets the weight of the picture's squared rotation for later calls.
  void use_upright(double weight);
  /// Uses finer maps to the disk, which resolve corners that correspond to long parts of the other
  /// outline, or the usual ones again. Returns false and changes nothing if rounding does not allow
  /// finer maps. Cost: about 100 ms the first time.
  bool use_sharp(bool sharp);
  bool is_sharp() const;
  /// The last correspondence, recomputed with the current maps to the disk. Cost: 1 ms.
  Correspondence last(const Points& pinned = {});
  /// The correspondence with the least stretch, ignoring pins and the picture's rotation. Cost: the
  /// same as for `best`.
  Correspondence least_stretched();
  /// Three arc lengths of the source and their images on the target. They define a correspondence.
  struct Pairs {
    std::array<double, 3> from{}, to{};
  };
  /// The pairs that define the last correspondence.
  const Pairs& pairs() const;
  /// Like `best`, but continues from the pairs of an earlier correspondence. Cost: about 4 ms.
  Correspondence follow(const Points& pinned, const Pairs& from);

 private:
  struct Search;
  std::unique_ptr<Search> search_;  ///< null if an outline is too thin
};

}  // namespace holomorph
