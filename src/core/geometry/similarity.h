// The rotation, scale and translation that best match points to other points.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

/// w -> factor (w - from) + to.
struct Similarity {
  Complex factor, from, to;
  Complex operator()(Complex w) const { return factor * (w - from) + to; }
};

/// The similarity that best maps the points `from` to the points `to`, in the least-squares sense.
/// If all points of `from` coincide, it is a translation. Both lists must have the same number of
/// points, at least one.
Similarity similarity_between(std::span<const Complex> from, std::span<const Complex> to);

}  // namespace holomorph
