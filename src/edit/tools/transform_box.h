// A box around several selected handles, which moves, turns and scales them.
#pragma once

#include <array>

#include "edit/input.h"
#include "edit/workspace.h"

namespace holomorph {

/// z -> a z + b conj(z) + c: turns, scales along both axes, moves.
struct Affine {
  Complex a{1}, b{0}, c{0};
  Complex operator()(Complex z) const { return a * z + b * std::conj(z) + c; }

  /// By these factors along x and y, or by an angle, about a place that stays.
  static Affine scaling(double x, double y, Complex about);
  static Affine turning(double angle, Complex about);
};

/// Handles taken along; tangents beside vertices go with these, pins that turn are turned and
/// scaled by `turn` radians and what the map does to lengths.
Deformation transformed(Deformation deformation, const Selection& selection, const Affine& map,
                        double turn, EditMode mode);

/// What is drawn of the box, in window px: corners from the lower left, counter-clockwise.
struct BoxMark {
  std::array<Complex, 4> corners;
  Complex knob;  ///< turns it
  std::optional<int>
      hovered;  ///< 0 to 7: grips from the lower left, counter-clockwise; 8: the knob
  /// Corners and the middles of edges, as they are counted.
  Complex grip(int number) const {
    const Complex corner = corners[static_cast<size_t>(number / 2)],
                  next = corners[static_cast<size_t>((number / 2 + 1) % 4)];
    return number == 8 ? knob : number % 2 == 0 ? corner : 0.5 * (corner + next);
  }
};

class TransformBox {
 public:
  /// Finds the box and what is under the pointer.
  void hover(const Input& input, const Workspace& workspace);
  bool hovered() const { return mark_ && mark_->hovered; }
  /// Whether the pointer is inside of it, beside its grips: a drag from there moves.
  bool inside() const { return inside_; }
  bool active() const { return active_; }
  const std::optional<BoxMark>& mark() const { return mark_; }
  std::string hint() const;
  void start(const Input& input, const Workspace& workspace);
  /// Follows the pointer; on release commits. Shift lets corners go freely, turns by 15 degrees and
  /// moves along an axis, Alt scales about the middle. A click inside selects nothing any more.
  void follow(const Input& input, Workspace& workspace);
  void cancel(Workspace& workspace);

 private:
  Affine map(const Input& input);
  BoxMark mark_of(const Workspace& workspace, const Affine& map) const;

  Box content_, box_;  ///< around the handles, and as it is drawn; in the plane
  double knob_ = 0;    ///< how far above it the knob is
  std::optional<BoxMark> mark_;
  int grip_ = 0;
  bool active_ = false, moving_ = false, inside_ = false;
  Complex start_px_, start_;
  double turn_ = 0;
  Deformation deformation_;
};

}  // namespace holomorph
