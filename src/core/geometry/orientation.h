// The orientation of a cage's loops.
#pragma once

#include "core/geometry/cage.h"

namespace holomorph {

/// The direction in which each loop of a rest cage must be traversed so that its inside is on the
/// left: the outer loop counter-clockwise, and the holes clockwise. Applies the same reversal to
/// the rest cage, its poses and all that belongs to them.
class Orientation {
 public:
  explicit Orientation(const Cage& rest);

  /// Whether all loops run in this direction already.
  bool is_oriented() const { return backward_.empty(); }
  /// The cage with the wrong loops traversed backward, each from the same first vertex. The cage
  /// must have the loops of the rest cage.
  Cage turned(const Cage& cage) const;
  /// A point on the rest cage as a point on the turned one, and the other way around.
  BoundaryPoint turned(BoundaryPoint point) const;
  /// For each control point of a cage, its index among the control points of the turned cage.
  std::vector<Index> columns(const Cage& cage) const;
  /// Values at the control points of a cage, in the order of the turned cage.
  VectorXc turned(const Cage& cage, const VectorXc& values) const;

 private:
  std::vector<Index> starts_;    ///< the first segment of each hole
  Index size_ = 0;               ///< of segments
  std::vector<Index> backward_;  ///< the loops that run in the wrong direction
};

/// The cage with its inside on the left of all of its loops.
Cage oriented(const Cage& cage);

}  // namespace holomorph
