// A closed curve that the user draws point by point.
#pragma once

#include "edit/tools/tool.h"

namespace holomorph {

/// A click sets a corner; dragging before the button is released makes the point smooth. The tool
/// that owns the path sets the first point.
class PenPath {
 public:
  bool active() const { return !nodes_.empty(); }
  /// Adds a point. Its tangent can be pulled out until the button is released.
  void set_point(Complex at);
  /// Follows the pointer. Returns true when a click on the first point or a double-click closes the
  /// curve.
  bool follow(const Input& input, const Viewport& view, double handle_px);

  enum class Answer { ignored, used, close, too_few };
  /// Enter closes the curve, Backspace or Delete removes the last point, Escape cancels.
  Answer key(Key key);
  void cancel() {
    nodes_.clear();
    placing_ = closes_ = false;
  }

  /// The closed curve: straight between corners, else cubic.
  Cage cage() const;
  /// Whether a click at the current position closes the curve.
  bool closes() const { return closes_; }
  void show(ToolOverlay& overlay) const;

 private:
  /// A point of the curve. A corner has the tangent 0.
  struct Node {
    Complex at, tangent;
  };
  static Points segment(const Node& from, const Node& to);
  Points drawn() const;
  Complex constrained(Complex z) const;

  std::vector<Node> nodes_;
  std::optional<Complex> pointer_;
  bool placing_ = false;  ///< the button is still down after the last point was set
  bool closes_ = false;
};

}  // namespace holomorph
