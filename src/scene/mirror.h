// Reflection about the vertical line through the middle of a deformation's rest cage.
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
    tolerance_ = 0.02 * box.diagonal();
  }

  /// The x coordinate of the line.
  double axis() const { return axis_; }
  Complex operator()(Complex z) const { return {2 * axis_ - z.real(), z.imag()}; }
  Points operator()(Points line) const {
    for (Complex& z : line) z = (*this)(z);
    return line;
  }
  /// The index of the counterpart of z, where z is one of the points. The counterpart is the point
  /// w nearest to the mirror image of z. It must lie within 2 % of the cage's size from that image,
  /// and z must be the point nearest to the mirror image of w. None if there is no such point.
  std::optional<size_t> counterpart(const Points& points, Complex z) const {
    const auto nearest_to = [&](Complex wanted) {
      return std::ranges::min_element(points, {}, [&](Complex w) { return std::abs(w - wanted); });
    };
    const auto nearest = nearest_to((*this)(z));
    if (nearest == points.end() || std::abs(*nearest - (*this)(z)) > tolerance_ ||
        *nearest_to((*this)(*nearest)) != z)
      return {};
    return static_cast<size_t>(nearest - points.begin());
  }

 private:
  double axis_ = 0, tolerance_ = 0;
};

/// The mirror image of a pose about the vertical line through the middle of the rest cage. Each
/// handle gets the mirrored pose of its counterpart, the handle at the mirrored rest position.
/// Throws Error if the rest state deviates from this symmetry by more than 2 % of its size.
Pose mirrored(const Deformation& deformation, const Pose& pose);

}  // namespace holomorph
