// The turn, scale and move that takes points nearest to others.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

/// w -> factor (w - from) + to.
struct Similarity {
  Complex factor, from, to;
  Complex operator()(Complex w) const { return factor * (w - from) + to; }
};

/// The similarity that takes points nearest to as many others, in the sense of least squares; a
/// translation where the first have no extent. Needs at least one point.
Similarity similarity_between(std::span<const Complex> from, std::span<const Complex> to);

}  // namespace holomorph
