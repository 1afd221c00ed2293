// The only conversion between window pixels and plane coordinates.
#pragma once

#include "core/geometry/similarity.h"
#include "core/types.h"

namespace holomorph {

/// The part of the plane that the canvas shows. In window px, x points right and y points down. It
/// is not called View, which is the heat map or pattern that is displayed.
struct Viewport {
  Complex center;                                   ///< plane point at the center of the canvas
  double zoom = 1;                                  ///< window px per plane unit
  double left = 0, top = 0, width = 1, height = 1;  ///< the canvas in window px
  Complex turn = 1;  ///< rotates a layer's plane around the center; 1 for the scene's plane

  Complex px_at_plane(Complex z) const {
    const Complex from_center = turn * (z - center) * zoom;
    return {left + width / 2 + from_center.real(), top + height / 2 - from_center.imag()};
  }
  Complex plane_at_px(Complex px) const {
    return center + plane_vector({px.real() - left - width / 2, px.imag() - top - height / 2});
  }
  /// The vector in the plane that is displayed as this one, in window px.
  Complex plane_vector(Complex px) const { return std::conj(px * turn) / zoom; }
  /// The part of a vector in the plane along the nearer axis of the canvas.
  Complex along_axis(Complex z) const {
    const Complex seen = turn * z;
    const bool across = std::abs(seen.real()) > std::abs(seen.imag());
    return std::conj(turn) * (across ? Complex(seen.real(), 0) : Complex(0, seen.imag()));
  }
  /// The same view of the plane of a layer with this placement.
  Viewport of_layer(const Similarity& placement) const {
    Viewport view = *this;
    const double scale = std::abs(placement.factor);
    view.center = inverse(placement)(center);
    view.zoom = zoom * scale;
    view.turn = turn * placement.factor / scale;
    return view;
  }
  bool contains_px(Complex px) const {
    return px.real() >= left && px.real() < left + width && px.imag() >= top &&
           px.imag() < top + height;
  }
  /// Zooms by a factor and keeps the plane point under `px` in place. The zoom stays within 0.001
  /// to 1000.
  void zoom_at(Complex px, double factor) {
    const Complex fixed = plane_at_px(px);
    zoom = std::clamp(zoom * factor, 1e-3, 1e3);
    center += fixed - plane_at_px(px);
  }
  void pan_px(Complex delta) { center -= Complex(delta.real(), -delta.imag()) / zoom; }
  /// Shows a box with a margin of `border` times its size on each side. Does nothing for an empty
  /// box.
  void fit(const Box& box, double border = 0.08) {
    if (box.empty()) return;
    center = box.center();
    const double w = std::max(box.width(), 1e-9), h = std::max(box.height(), 1e-9);
    zoom = std::clamp(std::min(width / w, height / h) / (1 + 2 * border), 1e-3, 1e3);
  }
};

}  // namespace holomorph
