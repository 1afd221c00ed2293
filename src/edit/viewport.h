// Window pixels to plane coordinates and back: the only place that knows both.
#pragma once

#include "core/types.h"

namespace holomorph {

/// The part of the plane that the canvas shows. Window px have x to the right and y down.
struct Viewport {
  Complex center;                                   ///< plane point in the middle of the canvas
  double zoom = 1;                                  ///< window px per plane unit
  double left = 0, top = 0, width = 1, height = 1;  ///< the canvas in window px

  Complex px_at_plane(Complex z) const {
    return {left + width / 2 + (z.real() - center.real()) * zoom,
            top + height / 2 - (z.imag() - center.imag()) * zoom};
  }
  Complex plane_at_px(Complex px) const {
    return center + Complex(px.real() - left - width / 2, -(px.imag() - top - height / 2)) / zoom;
  }
  bool contains_px(Complex px) const {
    return px.real() >= left && px.real() < left + width && px.imag() >= top &&
           px.imag() < top + height;
  }
  /// Zooms by a factor, keeping the plane point under `px` where it is.
  void zoom_at(Complex px, double factor) {
    const Complex fixed = plane_at_px(px);
    zoom = std::clamp(zoom * factor, 1e-3, 1e3);
    center += fixed - plane_at_px(px);
  }
  void pan_px(Complex delta) { center -= Complex(delta.real(), -delta.imag()) / zoom; }
  /// Shows a box with a border of `border` of its size.
  void fit(const Box& box, double border = 0.08) {
    if (box.empty()) return;
    center = box.center();
    const double w = std::max(box.width(), 1e-9), h = std::max(box.height(), 1e-9);
    zoom = std::clamp(std::min(width / w, height / h) / (1 + 2 * border), 1e-3, 1e3);
  }
};

}  // namespace holomorph
