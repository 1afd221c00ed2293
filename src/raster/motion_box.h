// The part of the plane that moving points cover.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// A part of a motion, between two times.
struct MotionPart {
  double from = 0, to = 0;
  /// The number of equal pieces in which paths bend so little that it can be estimated; 0 if the
  /// points move only at the end.
  int pieces = 0;
};

/// Extends `box` to contain all points at the start of a motion and during its parts, which follow
/// one another. `points_at` gives the points at a time, always in the same number. Returns false if
/// `keep_going` returns false.
bool include_motion(Box& box, const std::function<VectorXc(double)>& points_at,
                    const std::vector<MotionPart>& parts, const std::function<bool()>& keep_going);

}  // namespace holomorph
