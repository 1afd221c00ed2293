// The rotation, scale and translation that best match points to other points.
#pragma once

#include <span>

#include "core/types.h"

namespace holomorph {

/// w -> factor (w - from) + to. By default the identity.
struct Similarity {
  Complex factor = 1, from = 0, to = 0;
  Complex operator()(Complex w) const { return factor * (w - from) + to; }
  bool operator==(const Similarity&) const = default;
};

inline bool is_identity(const Similarity& s) {
  return s.factor == 1.0 && s.from == s.to;
}
/// The inverse. The factor must not be 0.
inline Similarity inverse(const Similarity& s) {
  return {1.0 / s.factor, s.to, s.from};
}
/// w -> outer(inner(w)), with `from` at 0, so that equal maps compare as equal up to rounding.
inline Similarity composed(const Similarity& outer, const Similarity& inner) {
  return {outer.factor * inner.factor, 0, outer(inner(0))};
}

/// The similarity that best maps the points `from` to the points `to`, in the least-squares sense.
/// If all points of `from` coincide, it is a translation. Both lists must have the same number of
/// points, at least one.
Similarity similarity_between(std::span<const Complex> from, std::span<const Complex> to);

}  // namespace holomorph
