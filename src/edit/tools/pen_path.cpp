// While the button is down, a drag sets the tangent of the last point.
#include "edit/tools/pen_path.h"

namespace holomorph {
namespace {

constexpr size_t kFewestNodes = 3;

}  // namespace

void PenPath::set_point(Complex at) {
  nodes_.push_back({at, 0});
  placing_ = true;
  closes_ = false;
}

bool PenPath::follow(const Input& input, const Viewport& view, double handle_px) {
  pointer_ = input.inside ? std::optional(input.position) : std::nullopt;
  if (placing_) {
    Node& node = nodes_.back();
    const double off = std::abs(view.px_at_plane(node.at) - input.px);
    if (node.tangent != Complex(0) || off >= kDragThresholdPx)
      node.tangent = input.position - node.at;
    placing_ = input.down && !input.released;
    return false;
  }
  closes_ = false;
  if (!input.inside) return false;
  const auto near = [&](const Node& node, double px) {
    return std::abs(view.px_at_plane(node.at) - input.px) < px;
  };
  closes_ = nodes_.size() >= kFewestNodes && near(nodes_[0], handle_px);
  if (input.mods.shift) pointer_ = constrained(input.position);
  if (!input.pressed) return false;
  // The second click of a double-click would set the same point again. It closes the curve instead.
  const bool repeated = near(nodes_.back(), kDragThresholdPx);
  if (closes_ || (input.double_clicked && repeated && nodes_.size() >= kFewestNodes)) return true;
  if (!repeated) set_point(*pointer_);
  return false;
}

PenPath::Answer PenPath::key(Key key) {
  if (!active()) return Answer::ignored;
  if (key == Key::enter) return nodes_.size() >= kFewestNodes ? Answer::close : Answer::too_few;
  if (key == Key::backspace || key == Key::del) {
    nodes_.pop_back();
    placing_ = closes_ = false;
  } else if (key == Key::escape) {
    cancel();
  } else {
    return Answer::ignored;
  }
  return Answer::used;
}

void PenPath::show(ToolOverlay& overlay) const {
  if (!active()) return;
  overlay.line = drawn();
  for (const Node& node : nodes_) overlay.line_points.push_back(node.at);
  if (!placing_) overlay.line_end = pointer_;
  overlay.closes = closes_;
}

Points PenPath::segment(const Node& from, const Node& to) {
  if (from.tangent == Complex(0) && to.tangent == Complex(0)) return {from.at};
  const Complex third = (to.at - from.at) / 3.0;
  return {from.at, from.at + (from.tangent == Complex(0) ? third : from.tangent),
          to.at - (to.tangent == Complex(0) ? third : to.tangent)};
}

Cage PenPath::cage() const {
  Cage cage;
  for (size_t i = 0; i < nodes_.size(); ++i)
    cage.segments.push_back(segment(nodes_[i], nodes_[(i + 1) % nodes_.size()]));
  return cage;
}

/// The open curve so far, as a polyline. Includes the tangent of the last point while that tangent
/// is being dragged.
Points PenPath::drawn() const {
  Points line;
  for (size_t i = 0; i + 1 < nodes_.size(); ++i) {
    Points controls = segment(nodes_[i], nodes_[i + 1]);
    controls.push_back(nodes_[i + 1].at);
    const int pieces = controls.size() == 2 ? 1 : 24;
    for (int k = 0; k < pieces; ++k)
      line.push_back(bezier_point(controls, static_cast<double>(k) / pieces));
  }
  line.push_back(nodes_.back().at);
  if (placing_ && nodes_.back().tangent != Complex(0))
    line.push_back(nodes_.back().at + nodes_.back().tangent);
  return line;
}

/// Moves z until its direction from the last point is a multiple of 15 degrees.
Complex PenPath::constrained(Complex z) const {
  const Complex by = z - nodes_.back().at;
  return nodes_.back().at +
         std::polar(std::abs(by), std::round(std::arg(by) / (kPi / 12)) * (kPi / 12));
}

}  // namespace holomorph
