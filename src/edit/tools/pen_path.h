// A closed curve that is being drawn point by point.
#pragma once

#include "edit/tools/tool.h"

namespace holomorph {

/// A click sets a corner; dragging on from there makes it smooth. Starting is its owner's.
class PenPath {
 public:
  bool active() const { return !nodes_.empty(); }
  /// The first point, or one more; its tangent can be pulled out until the button is let go.
  void set_point(Complex at);
  /// Follows the pointer. True when the curve is to be closed: by a click on its first point, or a
  /// double-click.
  bool follow(const Input& input, const Viewport& view, double handle_px);

  enum class Answer { ignored, used, close, too_few };
  /// Enter closes, Backspace takes a point back, Escape gives all up.
  Answer key(Key key);
  void cancel() {
    nodes_.clear();
    placing_ = closes_ = false;
  }

  /// Straight between corners, else cubic.
  Cage cage() const;
  /// Whether the next click closes it.
  bool closes() const { return closes_; }
  void show(ToolOverlay& overlay) const;

 private:
  /// A tangent of 0 is a corner.
  struct Node {
    Complex at, tangent;
  };
  static Points segment(const Node& from, const Node& to);
  Points drawn() const;
  Complex constrained(Complex z) const;

  std::vector<Node> nodes_;
  std::optional<Complex> pointer_;
  bool placing_ = false;  ///< the button is still down on the last point
  bool closes_ = false;
};

}  // namespace holomorph
