// The fewest frames that reproduce a motion by linear interpolation.
#pragma once

#include <functional>

#include "core/types.h"

namespace holomorph {

/// The positions of several meshes at several times.
struct Frames {
  std::vector<double> times;                   ///< increasing
  std::vector<std::vector<Points>> positions;  ///< for each time, those of each mesh
};

/// Two times that are this close, in seconds, are the two sides of a jump. What is between them is
/// ignored.
inline constexpr double kJump = 1e-3;
/// Whether two times are the two sides of a jump.
inline bool is_jump(double from, double to) {
  return to - from <= 1.1 * kJump;
}

/// Chooses few of the times such that linear interpolation between them is within `tolerance` of
/// the motion: at all of the times, and in the middle between them. Where they are too far apart,
/// adds times between them, at most 64 times as many. `times` is increasing and not empty; the
/// first and the last one are chosen. `exact` gives the positions at a time. Cost: two calls of
/// `exact` for each time, more where times are added, and comparisons with up to 200 others.
Frames fewest_frames(const std::vector<double>& times, double tolerance,
                     const std::function<std::vector<Points>(double time)>& exact);

}  // namespace holomorph
