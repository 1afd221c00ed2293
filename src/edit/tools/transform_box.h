// A box around several selected handles that moves, rotates and scales them together.
#pragma once

#include <array>

#include "edit/input.h"
#include "edit/workspace.h"

namespace holomorph {

/// The real-affine map z -> a z + b conj(z) + c: a rotation, a scaling along both axes and a
/// translation.
struct Affine {
  Complex a{1}, b{0}, c{0};
  Complex operator()(Complex z) const { return a * z + b * std::conj(z) + c; }

  /// Scales by factors along x and y, with `about` as the fixed point.
  static Affine scaling(double x, double y, Complex about);
  /// Rotates by an angle in radians around `about`.
  static Affine turning(double angle, Complex about);
};

/// Applies a map to handles. The control points next to a vertex move with it. In the pose, pins
/// that prescribe rotation and scale are also rotated by `turn` radians and scaled by the square
/// root of the map's area scale.
Deformation transformed(Deformation deformation, const Selection& selection, const Affine& map,
                        double turn, EditMode mode);

/// The box as it is drawn, in window px. Corners run counter-clockwise from the lower left one.
struct BoxMark {
  std::array<Complex, 4> corners;
  Complex knob;  ///< rotates the box
  std::optional<int>
      hovered;  ///< 0 to 7: grips, counter-clockwise from the lower left; 8: the knob
  /// The position of a grip: even numbers are corners, odd ones midpoints of edges, 8 is the knob.
  Complex grip(int number) const {
    const Complex corner = corners[static_cast<size_t>(number / 2)],
                  next = corners[static_cast<size_t>((number / 2 + 1) % 4)];
    return number == 8 ? knob : number % 2 == 0 ? corner : 0.5 * (corner + next);
  }
};

class TransformBox {
 public:
  /// Updates the box and determines which of its grips is under the pointer.
  void hover(const Input& input, const Workspace& workspace);
  bool hovered() const { return mark_ && mark_->hovered; }
  /// Whether the pointer is inside the box and not on a grip. A drag from there moves the handles.
  bool inside() const { return inside_; }
  bool active() const { return active_; }
  const std::optional<BoxMark>& mark() const { return mark_; }
  std::string hint() const;
  void start(const Input& input, const Workspace& workspace);
  /// Follows the pointer and commits on release. With Shift, corners scale both axes freely, the
  /// knob rotates in steps of 15 degrees, and moves are restricted to one axis. With Alt, scaling
  /// keeps the center fixed. A click inside the box clears the selection.
  void follow(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  Affine map(const Input& input);
  BoxMark mark_of(const Workspace& workspace, const Affine& map) const;

  Box content_, box_;  ///< bounding box of the handles, without and with the margin; in the plane
  double knob_ = 0;    ///< distance of the knob above the box
  std::optional<BoxMark> mark_;
  int grip_ = 0;
  bool active_ = false, moving_ = false, inside_ = false;
  Complex start_px_, start_;
  double turn_ = 0;
  Deformation deformation_;
};

}  // namespace holomorph
