// Points deep inside an outline.
#pragma once

#include "core/geometry/polyline.h"

namespace holomorph {

/// The interior point farthest from a closed polyline, accurate to rounding where it is unique.
/// Throws Error if the polyline encloses no area.
Complex deepest_point(const Polyline& outline);

/// A central point among those that are almost as deep as the deepest point. (All points on the
/// axis of a strip are equally deep.) Throws Error if the polyline encloses no area.
Complex middle_point(const Polyline& outline);

}  // namespace holomorph
