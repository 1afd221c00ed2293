// Left to right through the middle of a deformation's cage at rest.
#pragma once

#include <algorithm>
#include <optional>

#include "scene/deformation.h"

namespace holomorph {

class Mirror {
 public:
  explicit Mirror(const Deformation& deformation) {
    const Box box = box_of(outline_of(deformation.rest));
    axis_ = box.center().real();
    far_ = 0.02 * box.diagonal();
  }

  /// Where the line is.
  double axis() const { return axis_; }
  Complex operator()(Complex z) const { return {2 * axis_ - z.real(), z.imag()}; }
  Points operator()(Points line) const {
    for (Complex& z : line) z = (*this)(z);
    return line;
  }
  /// Which of these places, z among them, lies where the mirror takes z, and is taken to z; to 2 %
  /// of the cage's size.
  std::optional<size_t> counterpart(const Points& places, Complex z) const {
    const auto nearest_to = [&](Complex wanted) {
      return std::ranges::min_element(places, {}, [&](Complex w) { return std::abs(w - wanted); });
    };
    const auto nearest = nearest_to((*this)(z));
    if (nearest == places.end() || std::abs(*nearest - (*this)(z)) > far_ ||
        *nearest_to((*this)(*nearest)) != z)
      return {};
    return static_cast<size_t>(nearest - places.begin());
  }

 private:
  double axis_ = 0, far_ = 0;
};

}  // namespace holomorph
