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

/// The similarity that maps the points `from` closest to the points `to` in the least-squares
/// sense. It is a translation if `from` has no extent. Both need the same number of points, at
/// least one.
Similarity similarity_between(std::span<const Complex> from, std::span<const Complex> to);

}  // namespace holomorph
